"""Draw views with OpenGL as other drivers have it: `make test-drivers`.

Mesa has eight texture units and nearly every extension; a user's card may have less. Here a library
(driver.c) takes the place of OSMesa's, hides some of it, and refuses what a driver without it would
refuse. Each driver of DRIVERS draws the same views in a process of its own. It fails if a call was
refused, if a view was not drawn, or if a picture differs from Mesa's by more than the driver's
limit. It needs a C compiler and libOSMesa.so.8.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from ctypes.util import find_library
from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image

from landscape.gl.features import FEATURES
from landscape.island.island import MAIN
from landscape.offscreen import Offscreen

HERE = Path(__file__).parent
LIBRARY, RENAMED = b"libOSMesa.so.8", b"libOSMesa.so.R"
VIEWS = (*MAIN, "fig11a", "hall", "hall_caustics", "voxel_bay", "voxel_water")
SIZE = (400, 300)
VISIBLE = 40  # levels of 255: by so much a pixel is another one
SECONDS = 300  # chosen: for all views of one driver
SIX = (
    *("GL_ARB_framebuffer_object", "GL_EXT_framebuffer_object", "GL_NV_fog_distance"),
    *("GL_ARB_texture_env_crossbar", "GL_ARB_occlusion_query", "GL_ARB_texture_float"),
)


class Driver(NamedTuple):
    """What a driver has, as driver.c reads it, and how many per cent of the pixels may differ."""

    name: str
    has: dict[str, str]
    most: float = 100.0


def drivers() -> Iterator[Driver]:
    """Yield all drivers; the first is Mesa's own."""
    yield Driver("8 units", {"UNITS": "8"}, 0.0)
    yield Driver("4 units", {"UNITS": "4"}, 6.0)
    yield Driver("2 units", {"UNITS": "2"})
    yield Driver("1 unit", {"UNITS": "1"})
    yield Driver("thin lines", {"THIN": "1"}, 6.0)
    old = {"UNITS": "4", "VERSION": "2.1 Other", "HIDDEN": " ".join(SIX)}
    yield Driver("4 units, 2.1, six hidden", old)
    known = {name for each in FEATURES.values() for need in each.needs for name in need.extensions}
    for name in sorted(known):
        yield Driver(name, {"VERSION": "1.1 Other", "HIDDEN": name})
    yield Driver("OpenGL 1.1", {"UNITS": "1", "VERSION": "1.1 Other", "HIDDEN": "all"})


def build(folder: Path) -> None:
    """Put the library into a folder, and the real one, to which it is linked, renamed."""
    found = find_library("OSMesa")
    compiler = shutil.which("cc")
    if found != LIBRARY.decode() or compiler is None:
        sys.exit("drivers: needs libOSMesa.so.8 and a C compiler")
    lines = subprocess.run(["ldconfig", "-p"], capture_output=True, text=True, check=True).stdout
    real = next(line.split()[-1] for line in lines.splitlines() if f"{found} " in line)
    # Its own name for itself is a string in the file; the new one is as long.
    renamed = folder / RENAMED.decode()
    renamed.write_bytes(Path(real).read_bytes().replace(LIBRARY + b"\0", RENAMED + b"\0"))
    link = ["-Wl,--no-as-needed", f"-L{folder}", f"-l:{renamed.name}", "-Wl,-rpath,$ORIGIN", "-ldl"]
    own = [f"-Wl,-soname,{found}", "-o", str(folder / found)]
    source = str(HERE / "driver.c")
    subprocess.run([compiler, "-shared", "-fPIC", "-O1", source, *own, *link], check=True)


def draw(folder: Path) -> None:
    """Draw the views into a folder."""
    with Offscreen(SIZE, backend="osmesa") as offscreen:
        for view in VIEWS:
            offscreen.look(view)
            Image.fromarray(offscreen.draw()).save(folder / f"{view}.png")


def draw_with(driver: Driver, library: Path, out: Path) -> tuple[Path, list[str], str]:
    """Draw the views with a driver; return their folder, the refused calls and what went wrong."""
    folder = out / driver.name.replace(" ", "_").replace(",", "")
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / "refused.txt"
    log.unlink(missing_ok=True)
    environment = {f"DRIVER_{name}": value for name, value in driver.has.items()}
    environment |= {"LD_LIBRARY_PATH": str(library), "DRIVER_LOG": str(log)}
    command = [sys.executable, __file__, "--into", str(folder)]
    done = subprocess.run(
        command, env=os.environ | environment, capture_output=True, text=True, timeout=SECONDS
    )
    (folder / "notices.txt").write_text(done.stderr, encoding="utf-8")
    refused = log.read_text(encoding="utf-8").splitlines() if log.exists() else []
    return folder, refused, done.stderr.splitlines()[-1] if done.returncode else ""


def difference(one: Path, other: Path) -> float:
    """Return how many per cent of the pixels of two pictures are visibly different."""
    a, b = (np.asarray(Image.open(path).convert("RGB"), int) for path in (one, other))
    return float(100.0 * (np.abs(a - b).max(axis=2) > VISIBLE).mean())


def verdict(driver: Driver, folder: Path, own: Path, refused: list[str], wrong: str) -> str:
    """Return what is wrong with a driver's pictures, "" if nothing is; print a line about them."""
    if wrong:
        return wrong
    shares = {view: difference(own / f"{view}.png", folder / f"{view}.png") for view in VIEWS}
    worst = max(shares, key=lambda view: shares[view])
    print(f"{driver.name:34} {len(refused):4} refused, {shares[worst]:5.1f} % of {worst} differ")
    if refused:
        return f"{len(refused)} calls were refused, the first: {refused[0]}"
    if shares[worst] > driver.most:
        return f"{worst}: {shares[worst]:.1f} % of the pixels differ, at most {driver.most} may"
    return ""


def main() -> int:
    """Try all drivers, or those whose names contain a word; return 1 if one fails."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", metavar="WORD", help="drivers whose name has it")
    parser.add_argument("--out", type=Path, default=Path("out/drivers"), help="for the pictures")
    parser.add_argument("--into", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.into:
        draw(options.into)
        return 0
    mesa, *others = drivers()
    failed = 0
    with tempfile.TemporaryDirectory(prefix="drivers-") as temporary:
        build(Path(temporary))
        own = options.out
        for driver in (mesa, *(each for each in others if options.only in each.name)):
            folder, refused, wrong = draw_with(driver, Path(temporary), options.out)
            own = folder if driver is mesa else own
            if wrong := verdict(driver, folder, own, refused, wrong):
                print(f"{driver.name}: {wrong}")
                failed += 1

    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
