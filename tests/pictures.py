"""Golden pictures: comparing, writing what differs, and telling one renderer from another."""

import re
from pathlib import Path

import numpy as np
from PIL import Image

from landscape.gl.calls import gl

GOLDEN = Path(__file__).resolve().parent / "golden"
RENDERER = GOLDEN / "renderer.txt"
FAILURES = Path(__file__).resolve().parents[1] / "test-failures"

SAME = 1  # levels, on the renderer that drew the golden pictures
ELSEWHERE = 4  # levels: llvmpipe makes its code for the processor at hand
BEYOND = 0.001  # part of the pixels that may differ by more, elsewhere
AMPLIFIED = 16  # times, in the picture of the difference


def renderer() -> str:
    """Return renderer, version and processor: the same pixels are promised for these alone."""
    names = [gl.glGetString(name).decode() for name in (gl.GL_RENDERER, gl.GL_VERSION)]
    try:
        info = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        info = ""
    model = re.search(r"^model name\s*: (.*)$", info, re.MULTILINE)
    return "\n".join([*names, model.group(1) if model else "unknown processor"]) + "\n"


def difference(expected: np.ndarray, actual: np.ndarray) -> np.ndarray:
    """Return how far each pixel is off, int (h, w): the largest of its channels."""
    # Signed and wide: in uint8, 3 - 5 is 254.
    return np.abs(expected.astype(np.int64) - actual.astype(np.int64)).max(axis=2)


def agree(expected: np.ndarray, actual: np.ndarray, same_renderer: bool) -> bool:
    """Say whether two pictures (h, w, 3) are the same as far as the renderer allows."""
    if expected.shape != actual.shape:
        return False
    off = difference(expected, actual)
    if same_renderer:
        return bool(off.max() <= SAME)
    return bool((off > ELSEWHERE).mean() <= BEYOND)


def check(name: str, actual: np.ndarray, update: bool) -> None:
    """Compare with the golden picture, or write it with ``update``; AssertionError says where."""
    path = GOLDEN / f"{name}.png"
    actual = actual.astype(np.uint8)
    if update:
        GOLDEN.mkdir(exist_ok=True)
        Image.fromarray(actual).save(path, optimize=True)
        RENDERER.write_text(renderer(), encoding="utf-8")
        return
    assert path.exists(), f"{path} is missing: pytest --update-golden writes it; look at it then"
    expected = np.asarray(Image.open(path).convert("RGB"))
    same = RENDERER.exists() and RENDERER.read_text(encoding="utf-8") == renderer()
    if agree(expected, actual, same):
        return
    FAILURES.mkdir(exist_ok=True)
    for kind, picture in (("expected", expected), ("actual", actual)):
        Image.fromarray(picture).save(FAILURES / f"{name}-{kind}.png")
    if expected.shape != actual.shape:
        raise AssertionError(f"{name}: {expected.shape} expected, {actual.shape} drawn")
    signed = np.abs(expected.astype(np.int64) - actual.astype(np.int64))
    amplified = np.clip(signed * AMPLIFIED, 0, 255).astype(np.uint8)
    Image.fromarray(amplified).save(FAILURES / f"{name}-difference.png")
    off = difference(expected, actual)
    raise AssertionError(
        f"{name}: {(off > SAME).sum()} pixels differ, by up to {off.max()} levels; "
        f"see {FAILURES / name}-expected.png, -actual.png and -difference.png"
    )
