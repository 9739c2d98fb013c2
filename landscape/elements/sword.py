"""The sword: a sprite in front of everything (Sword, section 8).

Technique: one quad drawn last with the identity as modelview, blended, the depth test off. It bobs
with the walker's steps; a stroke swaps the texture four times.
State used: GL_BLEND, GL_TEXTURE_2D; depth test, fog and lighting off.
"""

import math
from pathlib import Path
from typing import Protocol, TypeVar

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from framelens.gl.texture import Texture
from landscape.elements.element import Element
from landscape.elements.settings import Sun
from landscape.elements.sun import direction, painted
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import picture_quad

STROKES = 4  # section 8.2
ASPECT = 3 / 2  # chosen: width by height of the pictures; in wider windows they are at the right


def bob(step: float) -> float:
    """Return how far the sword is raised, units at distance 1 (section 8.2)."""
    return 0.005 * math.cos(step / 4)


def pictures(assets: Assets) -> list[Path]:
    """Return the paths of the pictures, at rest and for each part of the stroke."""
    names = ["sword_rest.png"] + [f"sword_{k}.png" for k in range(1, STROKES + 1)]
    return [assets.path(name) for name in names]


class Lit(Protocol):
    """The settings of any scene with a sun."""

    @property
    def sun(self) -> Sun:
        """The sun and the sky's light."""


Values = TypeVar("Values", bound=Lit)


class Sword(Element[Values]):
    """The sword at rest and its stroke."""

    def __init__(self, settings: Values, assets: Assets) -> None:
        """Load the five pictures and compile the quad."""
        self.settings = settings
        self._textures = [Texture(read_image(path), repeat=False) for path in pictures(assets)]
        self._list = DisplayList(picture_quad)

    def draw(self, frame: Frame) -> None:
        """Draw the sword over the picture."""
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT
        with matrix(), attrib(groups):
            self._place(frame)
            gl.glColor3f(*painted(self.settings.sun, self._facing(frame)))
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            self._textures[frame.stroke].bind()
            self._list.call()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    @staticmethod
    def _place(frame: Frame) -> None:
        """Bring the square -1..1 to the sword's place in front of everything."""
        width, height = frame.size
        top = math.tan(math.radians(frame.fov / 2))
        right = top * width / height
        gl.glLoadIdentity()
        gl.glTranslatef(right - ASPECT * top, bob(frame.step) - 0.01 * top, 0.0)
        gl.glScalef(ASPECT * top, top, 1.0)
        for off in (gl.GL_DEPTH_TEST, gl.GL_FOG, gl.GL_LIGHTING):
            gl.glDisable(off)

    def _facing(self, frame: Frame) -> float:
        """Return how far the visible side of the sword faces the sun, as a cosine."""
        return float(direction(self.settings.sun) @ frame.back)

    def release(self) -> None:
        """Delete the list and the textures; may be called twice."""
        self._list.release()
        for texture in self._textures:
            texture.release()
