"""Golden pictures: reading, updating and comparing them, with the renderer that drew them."""

import os
import platform
import re
from pathlib import Path

import numpy as np
from PIL import Image

from framelens.gl.seam import gl
from landscape.gallery.compare import agree, amplified, difference

GOLDEN = Path(__file__).resolve().parent / "golden"
RENDERER = GOLDEN / "renderer.txt"
INSTRUCTIONS = ("avx", "avx2", "f16c", "fma")
SWITCHES = ("GALLIVM_PERF", "LP_PERF")
FAILURES = Path(__file__).resolve().parents[1] / "test-failures"


def renderer() -> str:
    """Return what decides about the last bit of a pixel: renderer, version, instructions, switches.

    llvmpipe compiles its code with the vector instructions that the processor has; a multiply-add
    rounds once instead of twice. The processor's name does not matter, GALLIVM_PERF does.
    """
    names = [gl.glGetString(name).decode() for name in (gl.GL_RENDERER, gl.GL_VERSION)]
    try:
        info = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        info = ""
    flags = re.search(r"^flags\s*: (.*)$", info, re.MULTILINE)
    words = flags.group(1).split() if flags else []
    found = [platform.machine(), *(name for name in INSTRUCTIONS if name in words)]
    switches = [f"{name}={os.environ[name]}" for name in SWITCHES if os.environ.get(name)]
    return "\n".join([*names, " ".join(found), *switches]) + "\n"


def golden(name: str) -> np.ndarray:
    """Return a golden picture, uint8 (h, w, 3)."""
    with Image.open(GOLDEN / f"{name}.png") as image:
        return np.asarray(image.convert("RGB"))


def same_renderer() -> bool:
    """Return whether the golden pictures were drawn by the renderer that draws now."""
    return RENDERER.exists() and RENDERER.read_text(encoding="utf-8") == renderer()


def check(name: str, actual: np.ndarray, update: bool, edges: bool = False) -> None:
    """Compare a picture with its golden one, or replace that with ``update``.

    ``edges`` says that it is all hard edges, of which another renderer may move a few. Where they
    differ, the AssertionError names three pictures: expected, actual and difference.
    """
    path = GOLDEN / f"{name}.png"
    actual = actual.astype(np.uint8)
    if update:
        GOLDEN.mkdir(exist_ok=True)
        Image.fromarray(actual).save(path, optimize=True)
        RENDERER.write_text(renderer(), encoding="utf-8")
        return

    assert path.exists(), f"{path} is missing: run pytest --update-golden, then look at it"
    expected = golden(name)
    if agree(expected, actual, same_renderer(), edges):
        return
    FAILURES.mkdir(exist_ok=True)
    shown = {"expected": expected, "actual": actual, "difference": amplified(expected, actual)}
    for kind, picture in shown.items():
        Image.fromarray(picture).save(FAILURES / f"{name}-{kind}.png")
    if expected.shape != actual.shape:
        raise AssertionError(f"{name}: {expected.shape} expected, {actual.shape} drawn")
    off = difference(expected, actual)
    raise AssertionError(
        f"{name}: {(off > 0).sum()} pixels differ, by up to {off.max()} levels; "
        f"see {FAILURES / name}-expected.png, -actual.png and -difference.png"
    )
