"""The last walk: where it ended and what was seen there, kept in the cache.

It begins the next one: its picture stands in the window while the scene is built, and the title
offers to go on from there. Without it, or where it cannot be read, nothing is offered.
"""

import contextlib
import json
import math
from dataclasses import astuple, dataclass
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image

from framelens.base.errors import InputError
from framelens.base.output import write_whole
from landscape.files import cache
from landscape.frame import Pose
from landscape.walk.thumbnails import thumbnail

PICTURE, PLACE = "last_walk.jpg", "last_walk.json"
WIDEST = 960  # chosen: pixels, the picture's width at most
QUALITY = 80  # chosen, of the JPEG
LARGEST = 1e6  # chosen: a place further away is none


@dataclass(frozen=True)
class LastWalk:
    """Where the last walk ended: the name of a view of its scene, and the pose."""

    view: str
    pose: Pose


def keep(picture: np.ndarray, last: LastWalk) -> None:
    """Keep what is seen, uint8 (h, w, 3), and where; without a cache that can be used, nothing."""
    place = cache.folder()
    if place is None:
        return
    image = Image.fromarray(picture)
    image.thumbnail((WIDEST, WIDEST), Image.Resampling.BOX)
    data = BytesIO()
    image.save(data, "JPEG", quality=QUALITY)
    written = json.dumps({"view": last.view, "pose": astuple(last.pose)[:5]})
    with contextlib.suppress(InputError, OSError):
        place.mkdir(parents=True, exist_ok=True)
        write_whole(place / PICTURE, data.getvalue())
        write_whole(place / PLACE, written.encode())


def read() -> LastWalk | None:
    """Return where the last walk ended, if that is known."""
    place = cache.folder()
    try:
        if place is None or (place / PLACE).stat().st_size > 1000:
            return None
        found = json.loads((place / PLACE).read_text("utf-8"))
        pose = Pose(*map(float, found["pose"]))
        sound = all(math.isfinite(each) and abs(each) < LARGEST for each in astuple(pose)[:5])
        return LastWalk(str(found["view"]), pose) if sound else None
    except (OSError, ValueError, TypeError, KeyError):
        return None


def picture() -> Path | None:
    """Return the file of the last walk's picture, if there is one."""
    place = cache.folder()
    path = place / PICTURE if place is not None else None
    return path if path is not None and path.is_file() else None


def first_picture(view: str, scene: str, pose: Pose) -> Path | None:
    """Return the picture that stands in for a view while its scene is built, if there is one.

    That of the last walk if it ended at the ``pose``, else one of the view, or of its scene.
    """
    found = read()
    if found is not None and found.pose == pose and picture() is not None:
        return picture()
    return thumbnail(view) or thumbnail(scene)
