"""The sky: five textured walls around the walker (Sky_box, section 4).

Technique: a sky box in a display list, translated with the viewer before it is called. In 2006 it
follows in x and z, never in y: walls that reach below the sea (``sky.sunk``) would be pulled out of
it as one climbs.
What is wrong with it, and the switches that show it: the ceiling comes nearer as one climbs
(``sky.follow_y``, R8, centres the box on the eye in every axis); its walls hide the terrain beyond
them (``sky.background``, R9, gives the box the greatest depth by glDepthRange(1, 1), so that it
shows only where nothing else is); corners are farther away and so more fogged than the middles of
the walls (``sky.unfogged``, R10, draws it without fog, as the haze is painted on it). Together the
three put the sky at infinity. It never changes: ``sky.moving`` (R1) asks for best/sky/fine_sky.py.
State used: GL_TEXTURE_2D; fog, depth range, depth writes and GL_CLIP_PLANE0 by the switches.
"""

from collections.abc import Hashable
from pathlib import Path

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from framelens.gl.texture import Texture
from landscape.elements.element import Element
from landscape.elements.settings import Settings
from landscape.elements.unfolded_sky import folded
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.files.smooth import read_smooth
from landscape.frame import Frame
from landscape.geometry.height_field import mirrored_height
from landscape.gl.display_list import DisplayList

NONE = "none"  # the value of sky.unfolded that names no picture
FACES = ("west", "north", "east", "south", "top")
# The files of each set of pictures by ``sky.set``: those of 2006, and those of ``sky.refined``.
PLAIN = {"day": "sky_{}.png", "sunset": "sky_sunset_{}.png"}
REFINED = {"day": "sky_fair_{}.jpg", "sunset": "sky_dusk_{}.jpg"}


def face_corners(d: float, h: float) -> dict[str, np.ndarray]:
    """Return each face's corners (4, 3), from the picture's top left downwards, seen from inside.

    The top face has north at its top and west at its left, as on a map.
    """
    wall = {"west": (-1, 1, -1, -1), "north": (-1, -1, 1, -1)}
    wall |= {"east": (1, -1, 1, 1), "south": (1, 1, -1, 1)}
    faces = {}
    for name, (x0, z0, x1, z1) in wall.items():
        faces[name] = np.array(
            [
                (x0 * d, h, z0 * d),
                (x0 * d, 0, z0 * d),
                (x1 * d, 0, z1 * d),
                (x1 * d, h, z1 * d),
            ],
            np.float32,
        )

    faces["top"] = np.array([(-d, h, -d), (-d, h, d), (d, h, d), (d, h, -d)], np.float32)
    return faces


def face_coordinates(width: int, height: int) -> np.ndarray:
    """Return texture coordinates (4, 2) of the corners, at the centres of the border texels.

    Neighbouring faces have the same border texels, so the box shows no seam.
    """
    s, t = 0.5 / width, 0.5 / height
    return np.array([(s, t), (s, 1 - t), (1 - s, 1 - t), (1 - s, t)], np.float32)


def set_files(name: str, refined: bool, assets: Assets) -> list[Path]:
    """Return the paths of the pictures of a set's faces; InputError if one is missing.

    Pictures of the plain names in the user's own folder are drawn by every preset, unless refined
    ones are beside them. Then all five are the plain set's, which match along their edges.
    """
    plain, better = ([names[name].format(face) for face in FACES] for names in (PLAIN, REFINED))
    if refined and assets.has_own(*plain) and not assets.has_own(*better):
        refined = False
    return [assets.path(each) for each in (better if refined else plain)]


def face_files(settings: Settings, assets: Assets) -> list[Path]:
    """Return the paths of the pictures of the faces; InputError if one is missing."""
    return set_files(settings.sky.set, settings.sky.refined, assets)


def face_images(settings: Settings, assets: Assets) -> list[np.ndarray]:
    """Return the pictures of the faces, uint8 (h, w, 3) each, from five files or from one.

    InputError if a file is missing or is no picture.
    """
    sky = settings.sky
    if sky.unfolded == NONE:
        return [read_smooth(path) for path in face_files(settings, assets)]
    sheet = read_image(assets.path(sky.unfolded, "sky.unfolded"), "RGB")
    faces = folded(sheet, sky.height / (2.0 * sky.half_width))
    return [faces[name] for name in FACES]


class SkyBox(Element[Settings]):
    """The box; ``draw`` follows the viewer."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return the values that the constructor uses."""
        sky = settings.sky
        return sky.set, sky.unfolded, sky.half_width, sky.height

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the five faces and compile the display list."""
        self.settings = settings
        sky = settings.sky
        images = face_images(settings, assets)
        levels = [self._levels(each) for each in images]
        # A sky is so smooth that the change from one mip level to the next does not show.
        self._textures = [Texture(each, repeat=False, trilinear=False) for each in levels]
        corners = face_corners(sky.half_width, sky.height)

        def send() -> None:
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glColor4f(1.0, 1.0, 1.0, 1.0)
            for face, texture, image in zip(FACES, self._textures, images, strict=True):
                texture.bind()
                gl.glBegin(gl.GL_QUADS)
                coordinates = face_coordinates(image.shape[1], image.shape[0])
                for (s, t), corner in zip(coordinates.tolist(), corners[face], strict=True):
                    gl.glTexCoord2f(s, t)
                    gl.glVertex3f(*corner.tolist())
                gl.glEnd()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
            gl.glDisable(gl.GL_TEXTURE_2D)

        self._list = DisplayList(send)

    def draw(self, frame: Frame) -> None:
        """Draw the box around the viewer, mirrored or not as the frame says."""
        sky, level = self.settings.sky, self.settings.water.level
        x, y, z = frame.eye.tolist()
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_COLOR_BUFFER_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_VIEWPORT_BIT
        with matrix(), attrib(groups):
            if sky.background:
                gl.glDepthRange(1.0, 1.0)
                gl.glDepthFunc(gl.GL_LEQUAL)
                gl.glDepthMask(gl.GL_FALSE)

            if sky.unfogged:
                gl.glDisable(gl.GL_FOG)
            if sky.anchored:
                x = z = self.settings.ground.size / 2
            if sky.follow_y:
                gl.glDisable(gl.GL_CLIP_PLANE0)
                # The mirror matrix puts this at the eye's own height again.
                foot = mirrored_height(y, level) if frame.mirrored else y
            else:
                foot = level

            gl.glTranslatef(x, foot - sky.sunk, z)
            self._list.call()
            self._draw_clouds(frame)

    def _levels(self, image: np.ndarray) -> list[np.ndarray]:
        """Return the mip levels of a face that are given; OpenGL makes the others."""
        return [image]

    def _draw_clouds(self, frame: Frame) -> None:
        """Draw what moves in front of the walls: in 2006 nothing does."""

    def release(self) -> None:
        """Delete the list and the textures; may be called twice."""
        self._list.release()
        for texture in self._textures:
            texture.release()
