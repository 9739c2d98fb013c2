"""The castle whose gate is drawn in one pass of three texture units (R11, section 11.2.4).

In 2006 door and light were blended over the bricks, and each of the three layers was fogged: the
gate wall is darker in fog than the walls beside it. Here one quad has all three textures, and is
lit and fogged once. Unit 0 interpolates between door and bricks by the door's alpha; it reads unit
1's texture to do so (the crossbar). Unit 1 multiplies by the halo and scales by 2, so that the
halo may brighten; unit 2 multiplies by the sun's light on the wall.
State used: as the castle; three texture units with GL_COMBINE (OpenGL 1.3) and
ARB_texture_env_crossbar (OpenGL 1.4); the texture matrix of unit 2.
"""

import numpy as np

from framelens.gl.named import texture_unit
from framelens.gl.seam import gl
from framelens.gl.state import attrib, combine, matrix
from framelens.gl.texture import Texture
from landscape.elements.castle import Castle
from landscape.elements.castle_gate import light_shift
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.geometry.height_field import HeightField
from landscape.geometry.masonry import walls_mesh
from landscape.geometry.mesh import Mesh
from landscape.gl.display_list import DisplayList

GATE_CORNERS = ((1.0, 0.0), (0.0, 0.0), (0.0, 1.0), (1.0, 1.0))  # x, y, in the order of the bricks
MIX = {
    "COMBINE_RGB": "INTERPOLATE",
    "SOURCE0_RGB": "TEXTURE1",
    "SOURCE1_RGB": "TEXTURE0",
    "SOURCE2_RGB": "TEXTURE1",
    "OPERAND2_RGB": "SRC_ALPHA",
}
TIMES = {"COMBINE_RGB": "MODULATE", "SOURCE0_RGB": "PREVIOUS"}

Unit = tuple[Texture, dict[str, str], float, np.ndarray]
"""A texture, the terms of its unit's GL_COMBINE, GL_RGB_SCALE, coordinates (4, 2) of the gate."""


def halo(light: np.ndarray) -> np.ndarray:
    """Return the light texture (h, w, 3) scaled so that its darkest colour, doubled, is white.

    In 2006 the light only darkened: by a grey of two thirds where no torch shines. This one leaves
    the wall unchanged there, and brightens it elsewhere.
    """
    darkest = np.maximum(light.reshape(-1, 3).min(axis=0), 1)
    return np.ascontiguousarray(np.clip(light * (127.5 / darkest) + 0.5, 0, 255), np.uint8)


def without_gate(walls: Mesh, repeat: float) -> Mesh:
    """Return the walls; of the gate wall's outer face, the first quad, only what is below y = 0."""
    vertices, coordinates = walls.vertices.copy(), walls.coordinates[0].copy()
    top = np.flatnonzero((np.arange(len(vertices)) < 4) & (vertices[:, 1] > 0))
    vertices[top, 1], coordinates[top, 1] = 0.0, repeat
    return Mesh(vertices, walls.normals, walls.triangles, (coordinates,))


class CastleInOnePass(Castle):
    """The castle of 2006 with its gate in one layer."""

    asked_by = ("castle.multitexture",)

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Compile the castle without its gate, and the gate."""
        super().__init__(settings, assets, field)
        self._gate = DisplayList(self._send_gate)

    def _light_image(self, image: np.ndarray) -> np.ndarray:
        return halo(image)

    def _walls(self) -> Mesh:
        return without_gate(
            walls_mesh(self._repeat, self.settings.castle.battlements), self._repeat
        )

    def _units(self) -> list[Unit]:
        """Return what the texture units of the gate hold and do, from unit 0 on."""
        flat = np.array([(x, 1.0 - y) for x, y in GATE_CORNERS])
        return [
            (self._brick, MIX, 1.0, flat * self._repeat),
            (self._door, TIMES | {"SOURCE1_RGB": "TEXTURE2"}, 2.0, flat),
            (self._light, TIMES | {"SOURCE1_RGB": "PRIMARY_COLOR"}, 1.0, flat),
        ]

    def _send_gate(self) -> None:
        """Send the gate wall as one quad; unit 2 is active afterwards, as it was before."""
        units = self._units()
        for number, (texture, terms, scale, _) in enumerate(units):
            gl.glActiveTexture(texture_unit(number))
            texture.bind()
            gl.glEnable(gl.GL_TEXTURE_2D)
            combine(terms)
            gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, scale)
        gl.glActiveTexture(gl.GL_TEXTURE2)
        gl.glNormal3f(0.0, 0.0, -1.0)
        gl.glBegin(gl.GL_QUADS)
        for k, (x, y) in enumerate(GATE_CORNERS):
            for number, (*_, coordinates) in enumerate(units):
                gl.glMultiTexCoord2f(texture_unit(number), *coordinates[k].tolist())
            gl.glVertex3f(x, y, 0.0)
        gl.glEnd()

    def _draw_gate(self, kt: float) -> None:
        """Draw the gate wall as one layer; its light moves by the texture matrix of unit 2."""
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT):
            shift_s, shift_t = light_shift(kt)
            gl.glActiveTexture(gl.GL_TEXTURE2)
            gl.glMatrixMode(gl.GL_TEXTURE)
            with matrix():
                # The near corner of the light, s = 0 and t = 1, stays where it is.
                gl.glTranslatef(0.0, -shift_t, 0.0)
                gl.glScalef(1.0 - shift_s, 1.0 + shift_t, 1.0)
                self._gate.call()
            gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_BLEND)
        gl.glDisable(gl.GL_LIGHTING)

    def release(self) -> None:
        """Delete the lists and the textures; may be called twice."""
        self._gate.release()
        super().release()
