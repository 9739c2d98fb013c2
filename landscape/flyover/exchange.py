"""A flight as plain files, for programs that read no SVG, and back again (section 2.4).

The document hands out a program that makes of an environment file a height map in BMP and data of
the path and of the orientation. A folder holds:

- ``heights.bmp``, the heights in 8 bits, and ``heights.png`` in 16: black is high;
- ``path.json``: the curves and the points to look at, in pixels, as the environment has them;
- ``flight.csv``: for each frame seconds, x, y, z in units, and the camera's angles in radians.

A folder is read again as an environment: from ``heights.png``, or else ``heights.bmp``, and
``path.json``.
"""

import io
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from PIL import Image

from framelens.base.errors import InputError, reason
from framelens.base.input import read_bounded
from framelens.base.output import write_whole
from landscape.files.images import open_image, red_values
from landscape.flyover.environment import WHITE16, Environment, checked
from landscape.flyover.settings import Flyover

FINE = "heights.png"
COARSE = "heights.bmp"
PATH = "path.json"
FLIGHT = "flight.csv"
HEAD = "seconds,x,y,z,theta_x,theta_y,theta_z"
MOST_BYTES = 4 << 20  # chosen: of path.json
VERSION = 1


def write(environment: Environment, settings: Flyover, folder: Path, fps: float) -> list[Path]:
    """Write a flight into a folder, which is made if need be; return the files.

    InputError if one cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError("{folder}: {reason}", folder=folder, reason=reason(error)) from None
    contents = {
        COARSE: encoded(np.rint(environment.image).astype(np.uint8), "BMP"),
        FINE: encoded(np.rint(environment.image * WHITE16).astype(np.uint16), "PNG"),
        PATH: json.dumps(path_of(environment), indent=1).encode() + b"\n",
        FLIGHT: "\n".join([HEAD, *places(environment, settings, fps)]).encode() + b"\n",
    }
    for name, data in contents.items():
        write_whole(folder / name, data)
    return [folder / name for name in contents]


def encoded(grey: np.ndarray, kind: str) -> bytes:
    """Return a grey image as the bytes of a file."""
    buffer = io.BytesIO()
    Image.fromarray(grey).save(buffer, kind)
    return buffer.getvalue()


def path_of(environment: Environment) -> dict[str, object]:
    """Return the path and the points to look at as plain lists, in pixels."""
    return {
        "version": VERSION,
        "path": [np.round(curves, 4).tolist() for curves in environment.subpaths],
        "targets": np.round(environment.targets, 4).tolist(),
    }


def places(environment: Environment, settings: Flyover, fps: float) -> Iterator[str]:
    """Yield a line for each frame: seconds, the camera's place in units, and its angles."""
    flight = environment.flight(environment.field(settings), settings)
    for number in range(max(round(flight.duration * fps), 1)):
        seconds = number / fps
        at = flight.camera(seconds)
        numbers = at.x, at.y, at.z, at.theta_x, at.theta_y, at.theta_z
        yield ",".join([f"{seconds:.4f}", *(f"{each:.6f}" for each in numbers)])


def read(folder: Path, any_size: bool = False) -> Environment:
    """Return the environment in a folder; InputError, one line, where something is missing."""
    image = next((folder / name for name in (FINE, COARSE) if (folder / name).exists()), None)
    if image is None:
        raise InputError(
            "{folder}: expected {fine} or {coarse} in it", folder=folder, fine=FINE, coarse=COARSE
        )
    heights = red_values(open_image(image))
    subpaths, targets = curves_in(folder / PATH)
    return checked(Environment(str(folder), heights, subpaths, targets), any_size)


def curves_in(path: Path) -> tuple[tuple[np.ndarray, ...], np.ndarray]:
    """Return the curves, each (n, 4, 2), and the points to look at (m, 2) of a path.json."""
    expected = f"{path}: expected a path as `landscape flyover --export` writes it"
    try:
        found = json.loads(read_bounded(path, MOST_BYTES))
        subpaths = tuple(np.array(each, np.float64).reshape(-1, 4, 2) for each in found["path"])
        targets = np.array(found["targets"], np.float64).reshape(-1, 2)
    except (KeyError, TypeError, ValueError, OverflowError, RecursionError):
        raise InputError(expected) from None
    curves = [each for each in subpaths if len(each)]
    if not curves or not all(np.isfinite(each).all() for each in (*curves, targets)):
        raise InputError(expected)
    return tuple(curves), targets
