"""Golden images: comparison, difference images, and identification of the renderer."""

import re
from pathlib import Path

import numpy as np
from PIL import Image

from landscape.gl.calls import gl

GOLDEN = Path(__file__).resolve().parent / "golden"
RENDERER = GOLDEN / "renderer.txt"
FAILURES = Path(__file__).resolve().parents[1] / "test-failures"

SAME = 1  # tolerance in levels on the renderer that made the golden images
ELSEWHERE = 4  # tolerance in levels elsewhere: llvmpipe generates code for each processor
BEYOND = 0.001  # fraction of the pixels that may differ by more than ELSEWHERE
AMPLIFIED = 16  # contrast factor of the difference image


def renderer() -> str:
    """Return renderer, version and processor; only with the same ones are pixels the same."""
    names = [gl.glGetString(name).decode() for name in (gl.GL_RENDERER, gl.GL_VERSION)]
    try:
        info = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        info = ""
    model = re.search(r"^model name\s*: (.*)$", info, re.MULTILINE)
    return "\n".join([*names, model.group(1) if model else "unknown processor"]) + "\n"


def difference(expected: np.ndarray, actual: np.ndarray) -> np.ndarray:
    """Return the difference of each pixel, int (h, w): the maximum over its channels."""
    # Convert first: in uint8, 3 - 5 is 254.
    return np.abs(expected.astype(np.int64) - actual.astype(np.int64)).max(axis=2)


def agree(expected: np.ndarray, actual: np.ndarray, same_renderer: bool) -> bool:
    """Return whether two images (h, w, 3) are the same within the tolerance of the renderer."""
    if expected.shape != actual.shape:
        return False
    off = difference(expected, actual)
    if same_renderer:
        return bool(off.max() <= SAME)
    return bool((off > ELSEWHERE).mean() <= BEYOND)


def check(name: str, actual: np.ndarray, update: bool) -> None:
    """Compare with the golden image, or write it if ``update``.

    If they differ, write both and their difference to FAILURES and raise AssertionError.
    """
    path = GOLDEN / f"{name}.png"
    actual = actual.astype(np.uint8)
    if update:
        GOLDEN.mkdir(exist_ok=True)
        Image.fromarray(actual).save(path, optimize=True)
        RENDERER.write_text(renderer(), encoding="utf-8")
        return
    assert path.exists(), (
        f"{path} is missing: write it with pytest --update-golden, then inspect it"
    )
    expected = np.asarray(Image.open(path).convert("RGB"))
    same = RENDERER.exists() and RENDERER.read_text(encoding="utf-8") == renderer()
    if agree(expected, actual, same):
        return
    FAILURES.mkdir(exist_ok=True)
    for kind, picture in (("expected", expected), ("actual", actual)):
        Image.fromarray(picture).save(FAILURES / f"{name}-{kind}.png")
    if expected.shape != actual.shape:
        raise AssertionError(f"{name}: expected {expected.shape}, rendered {actual.shape}")
    signed = np.abs(expected.astype(np.int64) - actual.astype(np.int64))
    amplified = np.clip(signed * AMPLIFIED, 0, 255).astype(np.uint8)
    Image.fromarray(amplified).save(FAILURES / f"{name}-difference.png")
    off = difference(expected, actual)
    raise AssertionError(
        f"{name}: {(off > SAME).sum()} pixels differ, by up to {off.max()} levels; "
        f"see {FAILURES / name}-expected.png, -actual.png and -difference.png"
    )
