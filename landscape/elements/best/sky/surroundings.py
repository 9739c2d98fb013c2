"""What is around a place in the bay, as the faces of a cube map: the sky above, the sea below.

No OpenGL. The sky is that of the box's five pictures (sky_box.py), seen from its centre; the sea
has the water's colour where one looks down on it, and mirrors the sky towards the horizon. Land,
trees and the castle are left out: what mirrors this is bent, so that nobody misses them.
"""

import numpy as np

from landscape.elements.settings import Settings
from landscape.elements.sky_box import face_files
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.files.images import read_image
from landscape.gl.cube_map import face_directions

SIDE = 64  # chosen: texels per side of a face
COARSE = 128  # chosen: texels per side of the sky's pictures that are looked up, at most


def coarser(picture: np.ndarray, most: int = COARSE) -> np.ndarray:
    """Return a picture (h, w, 3) averaged over squares, so that it is at most ``most`` wide."""
    step = -(-picture.shape[1] // most)
    height, width = (max(side // step, 1) for side in picture.shape[:2])
    step_y, step_x = picture.shape[0] // height, picture.shape[1] // width
    part = picture[: height * step_y, : width * step_x].astype(np.float32)
    return np.asarray(part.reshape(height, step_y, width, step_x, 3).mean(axis=(1, 3)))


def face_of(towards: np.ndarray, rise: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the sky's face that each direction (n, 3) meets, and where: s and t in 0..1, (n,).

    The faces are numbered as in FACES; ``rise`` is the box's height by half its width. Directions
    below the horizon meet the walls' lower edge.
    """
    x, y, z = towards.T
    wide = np.maximum(np.maximum(np.abs(x), np.abs(z)), 1e-9)
    up = np.maximum(y, 0.0) / wide
    top = up > rise
    walls = [(x <= -wide, -z), (z <= -wide, x), (x >= wide, z), (z >= wide, -x)]
    face = np.select([top, *(at for at, _ in walls)], [4, 0, 1, 2, 3])
    along = np.select([at for at, _ in walls], [value for _, value in walls]) / wide
    height = np.maximum(y, 1e-9) / rise
    s = np.where(top, x / height, along)
    t = np.where(top, z / height, 1 - 2 * up / rise)
    return face, (s + 1) / 2, (t + 1) / 2


def sky_colours(sky: list[np.ndarray], rise: float, towards: np.ndarray) -> np.ndarray:
    """Return the colours (n, 3), 0..255, of a sky's five pictures in directions (n, 3)."""
    face, s, t = face_of(towards, rise)
    found = np.empty((len(towards), 3), np.float32)
    for number, picture in enumerate(sky):
        mine = face == number
        height, width = picture.shape[:2]
        column = np.clip((s[mine] * width).astype(int), 0, width - 1)
        row = np.clip((t[mine] * height).astype(int), 0, height - 1)
        found[mine] = picture[row, column]
    return found


def sea_colour(settings: Settings) -> np.ndarray:
    """Return the colour (3,), 0..255, of the level sea from above, as its material is lit."""
    sun = settings.sun
    light = np.array(sun.ambient) + np.array(sun.diffuse) * direction(sun)[1]
    return np.asarray(np.clip(np.array(settings.water.color[:3]) * light, 0.0, 1.0) * 255)


def built_from(settings: Settings) -> tuple[object, ...]:
    """Return the settings that the faces depend on."""
    box = settings.sky.height / settings.sky.half_width
    return settings.sky.set, settings.sky.refined, box, tuple(sea_colour(settings).tolist())


def surroundings(settings: Settings, assets: Assets) -> np.ndarray:
    """Return the faces of a cube map, uint8 (6, SIDE, SIDE, 3), from the cache if they are there.

    InputError names a picture of the sky that cannot be used.
    """
    files = face_files(settings, assets)
    what: list[bytes | str] = ["surroundings", repr(built_from(settings)), *map(content, files)]

    def make() -> tuple[np.ndarray]:
        towards = face_directions(SIDE).reshape(-1, 3)
        rise = settings.sky.height / settings.sky.half_width
        sky = [coarser(read_image(path, "RGB")) for path in files]
        below = towards[:, 1:2] < 0
        colours = sky_colours(sky, rise, towards * np.where(below, (1.0, -1.0, 1.0), 1.0))
        mirrored = np.where(below, (1 - np.abs(towards[:, 1:2])) ** 3, 1.0)
        colours = colours * mirrored + sea_colour(settings) * (1 - mirrored)
        return (np.rint(colours).astype(np.uint8).reshape(6, SIDE, SIDE, 3),)

    return recall(what, make)[0]
