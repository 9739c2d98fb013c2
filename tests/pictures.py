"""Golden pictures: reading, updating and comparing them, with the renderer that drew them."""

import re
from pathlib import Path

import numpy as np
from PIL import Image

from landscape.gallery.compare import SAME_RENDERER, agree, amplified, difference
from landscape.gl.calls import gl

GOLDEN = Path(__file__).resolve().parent / "golden"
RENDERER = GOLDEN / "renderer.txt"
FAILURES = Path(__file__).resolve().parents[1] / "test-failures"


def renderer() -> str:
    """Return renderer, version and processor: only these together promise the same pixels."""
    names = [gl.glGetString(name).decode() for name in (gl.GL_RENDERER, gl.GL_VERSION)]
    try:
        info = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        info = ""
    model = re.search(r"^model name\s*: (.*)$", info, re.MULTILINE)
    return "\n".join([*names, model.group(1) if model else "unknown processor"]) + "\n"


def check(name: str, actual: np.ndarray, update: bool) -> None:
    """Compare a picture with its golden one, or replace that with ``update``.

    Where they differ, the AssertionError names three pictures: expected, actual and difference.
    """
    path = GOLDEN / f"{name}.png"
    actual = actual.astype(np.uint8)
    if update:
        GOLDEN.mkdir(exist_ok=True)
        Image.fromarray(actual).save(path, optimize=True)
        RENDERER.write_text(renderer(), encoding="utf-8")
        return
    assert path.exists(), f"{path} is missing: run pytest --update-golden, then look at it"
    expected = np.asarray(Image.open(path).convert("RGB"))
    same = RENDERER.exists() and RENDERER.read_text(encoding="utf-8") == renderer()
    if agree(expected, actual, same):
        return
    FAILURES.mkdir(exist_ok=True)
    shown = {"expected": expected, "actual": actual, "difference": amplified(expected, actual)}
    for kind, picture in shown.items():
        Image.fromarray(picture).save(FAILURES / f"{name}-{kind}.png")
    if expected.shape != actual.shape:
        raise AssertionError(f"{name}: {expected.shape} expected, {actual.shape} drawn")
    off = difference(expected, actual)
    raise AssertionError(
        f"{name}: {(off > SAME_RENDERER).sum()} pixels differ, by up to {off.max()} levels; "
        f"see {FAILURES / name}-expected.png, -actual.png and -difference.png"
    )
