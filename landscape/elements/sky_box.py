"""The sky: five textured walls round the walker (Sky_box, section 4).

Technique: a sky box in a display list, translated with the viewer before it is called. In 2006 it
follows in x and z, never in y, stands in the fog and hides what lies behind its walls. With
``sky.infinite`` it is drawn before everything, without depth or fog and about the eye itself, so it
is a background at infinity.
State used: GL_TEXTURE_2D; with ``sky.infinite`` depth test and fog are off while it is drawn.
"""

import numpy as np

from landscape.assets import Assets
from landscape.frame import Frame
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.state import attrib, matrix
from landscape.gl.texture import Texture, read_image
from landscape.settings import Settings

ELEMENT = "sky"

FACES = ("west", "north", "east", "south", "top")


def face_corners(d: float, h: float) -> dict[str, np.ndarray]:
    """Return each face's corners (4, 3), from the picture's top left, going down, seen from inside.

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
    """Return texture coordinates (4, 2) of the corners that touch the border texels' centres.

    The faces' border texels agree, so the box shows no seam.
    """
    s, t = 0.5 / width, 0.5 / height
    return np.array([(s, t), (s, 1 - t), (1 - s, 1 - t), (1 - s, t)], np.float32)


class SkyBox:
    """The box; ``draw`` follows the viewer."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the five faces and compile the display list."""
        self._settings = settings
        prefix = "sky_" if settings.sky.set == "day" else f"sky_{settings.sky.set}_"
        images = [read_image(assets.path(f"{prefix}{face}.png"), "RGB") for face in FACES]
        self._textures = [Texture(image, repeat=False) for image in images]
        corners = face_corners(settings.sky.half_width, settings.sky.height)

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
        """Draw the box about the viewer, mirrored or not as the frame says."""
        level = self._settings.water.level
        x, y, z = frame.eye.tolist()
        with matrix(), attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT):
            if self._settings.sky.infinite:
                gl.glDisable(gl.GL_DEPTH_TEST)
                gl.glDisable(gl.GL_FOG)
                gl.glDisable(gl.GL_CLIP_PLANE0)
                # Under the mirror matrix the eye's own place is that of its mirror image.
                gl.glTranslatef(x, 2 * level - y if frame.mirrored else y, z)
            else:
                gl.glTranslatef(x, level, z)
            self._list.call()

    def release(self) -> None:
        """Delete the list and the textures; may be called twice."""
        self._list.release()
        for texture in self._textures:
            texture.release()
