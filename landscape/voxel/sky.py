"""The sky: a cube map, looked up by the direction in which one looks.

Technique: a box around the eye whose texture coordinates are the directions to its corners, with a
cube map (GL_ARB_texture_cube_map, OpenGL 1.3). Unlike the island's sky box it needs no care at its
edges, and it is drawn after the land, where the depth buffer is still empty. Its six images are
made from the island's pictures, which show the walls and the ceiling of a box half as high as wide.
State used: GL_TEXTURE_CUBE_MAP, the depth function, the depth range.
Below the horizon it has the colour of the sea there, so that one sees where the sea ends.
What is wrong with it: the clouds do not move.
"""

import itertools

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from landscape.elements.element import Element
from landscape.elements.sky_box import FACES, set_files
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.files.smooth import read_smooth
from landscape.frame import Frame
from landscape.gl.cube_map import CubeMap, directions_through
from landscape.gl.display_list import DisplayList
from landscape.gl.features import possible
from landscape.voxel.settings import Settings

HEIGHT = (
    0.5  # of the pictures' box, in halves of its width: the walls are four times as wide as high
)
SIDE = 1024  # texels, chosen: side of a face of the cube map
ROWS = 128  # texels, chosen: as many rows are made at once, which keeps memory small
BLEND = 0.035  # chosen: sine of the elevation below which the sky turns into haze
# The corners of the box that is drawn around the eye, by face.
BOX = tuple(
    tuple((x, y, z) for x, y, z in corners)
    for corners in (
        ((1, -1, -1), (1, -1, 1), (1, 1, 1), (1, 1, -1)),
        ((-1, -1, 1), (-1, -1, -1), (-1, 1, -1), (-1, 1, 1)),
        ((-1, 1, -1), (1, 1, -1), (1, 1, 1), (-1, 1, 1)),
        ((-1, -1, 1), (1, -1, 1), (1, -1, -1), (-1, -1, -1)),
        ((1, -1, 1), (-1, -1, 1), (-1, 1, 1), (1, 1, 1)),
        ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)),
    )
)


def sampled(picture: np.ndarray, s: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Return colours (n, 3) of a picture (h, w, 3) at s, t (n,) in 0..1, between texels linear."""
    h, w = picture.shape[:2]
    x, y = np.clip(s * w - 0.5, 0, w - 1), np.clip(t * h - 0.5, 0, h - 1)
    x0, y0 = np.minimum(x.astype(int), w - 2), np.minimum(y.astype(int), h - 2)
    fx, fy = (x - x0)[:, None], (y - y0)[:, None]
    upper = picture[y0, x0] * (1 - fx) + picture[y0, x0 + 1] * fx
    lower = picture[y0 + 1, x0] * (1 - fx) + picture[y0 + 1, x0 + 1] * fx
    return np.asarray(upper * (1 - fy) + lower * fy)


def sky_colours(
    pictures: dict[str, np.ndarray], directions: np.ndarray, haze: np.ndarray, sea: np.ndarray
) -> np.ndarray:
    """Return the sky's colours (n, 3) in unit directions (n, 3): x east, y up, z south.

    The ray meets either a wall of the pictures' box or its ceiling. Towards the horizon they turn
    into the colour ``haze`` (3,), and below it is that of the ``sea`` (3,).
    """
    x, y, z = directions.T
    reach = np.maximum(np.maximum(np.abs(x), np.abs(z)), 1e-9)
    up = y / reach  # where the ray meets the walls of a box whose half width is 1
    found = np.tile(np.asarray(haze, np.float64), (len(directions), 1))
    walls = {
        "west": (-x == reach, -z),
        "north": (-z == reach, x),
        "east": (x == reach, z),
        "south": (z == reach, -x),
    }
    for name, (beyond, along) in walls.items():
        at = np.flatnonzero(beyond & (up >= 0) & (up < HEIGHT))
        s = (along[at] / reach[at] + 1) / 2
        found[at] = sampled(pictures[name], s, 1 - up[at] / HEIGHT)

    at = np.flatnonzero((y > 0) & (up >= HEIGHT))
    s, t = ((each[at] / y[at] * HEIGHT + 1) / 2 for each in (x, z))
    found[at] = sampled(pictures["top"], s, t)
    clear = np.clip(y / BLEND, 0.0, 1.0)[:, None]
    found = found * clear + np.asarray(haze) * (1 - clear)
    return np.where((y < 0)[:, None], sea, found)


def colours(settings: Settings) -> tuple[object, ...]:
    """Return the settings that the cube map is made of."""
    return settings.sky, settings.fog.color, settings.water.horizon


class Sky(Element[Settings]):
    """The sky around the eye."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the pictures, make the cube map and compile the box."""
        self.settings, self._assets = settings, assets
        self._map: CubeMap | None = None
        if not possible("sky"):
            return
        self._map = CubeMap(self._faces(settings), mipmaps=False)
        self._list = DisplayList(send_box)

    def _faces(self, settings: Settings) -> np.ndarray:
        """Return the images of the cube map, uint8 (6, n, n, 3), made once."""
        paths = dict(zip(FACES, set_files(settings.sky.set, True, self._assets), strict=True))
        haze = 255.0 * np.array(settings.fog.color)
        sea = 255.0 * np.array(settings.water.horizon)

        def make() -> tuple[np.ndarray]:
            pictures = {name: read_smooth(path) for name, path in paths.items()}
            faces = np.empty((6, SIDE, SIDE, 3), np.uint8)
            for face, start in itertools.product(range(6), range(0, SIDE, ROWS)):
                rows = slice(start, start + ROWS)
                directions = directions_through(face, SIDE, rows)
                colours = sky_colours(pictures, directions.reshape(-1, 3), haze, sea)
                faces[face, rows] = (colours + 0.5).astype(np.uint8).reshape(-1, SIDE, 3)
            return (faces,)

        pixels = [content(path) for path in paths.values()]
        return recall(["voxel sky", haze.tobytes(), sea.tobytes(), *pixels], make)[0]

    def draw(self, frame: Frame) -> None:
        """Draw the sky where nothing else is, mirrored or not as the modelview matrix is."""
        if self._map is None:
            return
        groups = gl.GL_ENABLE_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_VIEWPORT_BIT
        with attrib(groups | gl.GL_CURRENT_BIT), matrix():
            gl.glTranslatef(*frame.eye.tolist())
            gl.glDisable(gl.GL_FOG)
            gl.glDisable(gl.GL_CLIP_PLANE0)  # in the water's mirror it would cut the box
            gl.glDepthRange(1.0, 1.0)
            gl.glDepthFunc(gl.GL_LEQUAL)
            gl.glDepthMask(gl.GL_FALSE)
            self._map.bind()
            gl.glEnable(gl.GL_TEXTURE_CUBE_MAP)
            self._list.call()
            gl.glBindTexture(gl.GL_TEXTURE_CUBE_MAP, 0)

    def take(self, settings: Settings) -> None:
        """Take other settings, with another cube map for another sky; InputError for its files."""
        if self._map is not None and colours(settings) != colours(self.settings):
            other = CubeMap(self._faces(settings), mipmaps=False)
            self._map.release()
            self._map = other
        self.settings = settings

    def release(self) -> None:
        """Delete the cube map and the list; may be called twice."""
        if self._map is not None:
            self._map.release()
            self._list.release()


def send_box() -> None:
    """Send the box, each corner with the direction to it as its texture coordinates."""
    gl.glColor3f(1.0, 1.0, 1.0)
    gl.glBegin(gl.GL_QUADS)
    for face in BOX:
        for corner in face:
            gl.glTexCoord3f(*map(float, corner))
            gl.glVertex3f(*map(float, corner))
    gl.glEnd()
