"""The caustics: sunlight that the water focuses on the pool's bed, and throws on the hall.

Technique: a film of the net of light (elements/caustic_film.py), laid over the stone by generated
texture coordinates (glTexGen; glSkel, caustics): s and t are linear in the place, so that nothing
needs coordinates of its own. The planes have a part of y, or the net would be drawn out to stripes
on the upright sides.
On the bed the net multiplies what is there. ``caustics.passes`` chooses how. ``two``: the bed is
drawn again, blended. The document's glBlendFunc(GL_ZERO, GL_SRC_COLOR) can only darken, as no
colour exceeds 1; GL_DST_COLOR, GL_ONE adds the product to what is there, a factor of 1 to 2;
GL_DST_COLOR, GL_SRC_COLOR adds it twice, a factor of 0 to 2, which keeps the mean: that is used.
``one``: two further texture units do it while the bed is drawn: the first takes the net into alpha,
and the second multiplies the colour by that alpha and by GL_RGB_SCALE 2.
Only the sun's light is focused. The light map holds as alpha how much of a texel's light is the
sun's, and GL_INTERPOLATE moves the net towards what changes nothing, the less of it that is.
What the water throws on pillars, walls and vault is new light, so there stone times net is added
(GL_ONE, GL_ONE). It fades with distance and angle by vertex colours (reflected_light.py). Python
mixes the film's two frames: that takes one texture unit less.
What is wrong without its safeguards: ``caustics.doubled`` off, as printed, the pool only darkens;
``caustics.planes=eye_before_camera`` gives the planes under the identity matrix, so that the net
sticks to the eye; ``caustics.own_t`` off gives both coordinates the same plane, as printed, and the
net becomes stripes; ``caustics.pattern=sines`` shows dots; without ``caustics.smooth`` it jumps;
without ``caustics.sunlit`` the net is as strong in shade as in sun.
State used: up to four texture units with GL_COMBINE (OpenGL 1.3), generated texture coordinates,
GL_BLEND, depth test, polygon offset.
"""

from collections.abc import Hashable, Iterator
from contextlib import contextmanager
from typing import Self

import numpy as np

from framelens.gl.named import texture_unit
from framelens.gl.seam import gl
from framelens.gl.state import attrib, combine, front_faces, matrix
from landscape.elements.caustic_film import MixedFilm, shipped, sines
from landscape.elements.element import Element, Site
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.features import possible
from landscape.hall.kept_meshes import kept_meshes
from landscape.hall.levels import levels_of
from landscape.hall.reflected_light import LIT, brighter, lit_meshes
from landscape.hall.room import Room
from landscape.hall.settings import Settings

FIRST_FREE = 2  # the texture unit after those of the stone and of the light on it
FRAMES = 32  # of the product of sines
# How much of y is in s and in t. In the basin as in glSkel, caustics, whose planes are 0.05, 0.03,
# 0 and 0, 0.03, 0.05; on walls, where y replaces x or z, more in one of them (chosen).
SLANT, UPRIGHT = (0.6, 0.6), (1.0, 0.3)
LARGER = 2.5  # chosen: the net is blurred and enlarged on the way to the walls


def planes(settings: Settings, slant: tuple[float, float] = SLANT) -> np.ndarray:
    """Return the planes of s and t, float32 (2, 4); s is the first times (x, y, z, 1)."""
    s, t = (1.0, slant[0], 0.0, 0.0), (0.0, slant[1], 1.0, 0.0)
    both = np.array([s, t if settings.caustics.own_t else s], np.float32)
    return both * np.float32(settings.caustics.scale)


def generate(both: np.ndarray, how: str) -> None:
    """Let the active unit generate s and t by planes (2, 4), in the way ``caustics.planes`` says.

    GL_EYE_LINEAR multiplies an eye plane by the inverse of the modelview matrix that is current
    when the plane is given. Under the camera's that undoes the camera, and the plane is in the
    world; under the identity it stays in the eye's coordinates.
    """
    mode, name = gl.GL_EYE_LINEAR, gl.GL_EYE_PLANE
    if how == "object":
        mode, name = gl.GL_OBJECT_LINEAR, gl.GL_OBJECT_PLANE
    with matrix():
        if how == "eye_before_camera":
            gl.glLoadIdentity()
        for coordinate, plane in zip((gl.GL_S, gl.GL_T), both, strict=True):
            gl.glTexGeni(coordinate, gl.GL_TEXTURE_GEN_MODE, mode)
            gl.glTexGenfv(coordinate, name, plane)
    gl.glEnable(gl.GL_TEXTURE_GEN_S)
    gl.glEnable(gl.GL_TEXTURE_GEN_T)


class Caustics(Element[Settings]):
    """The net of light on the pool's basin, and on the stone around it."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return what the constructor uses of the settings."""
        return settings.caustics.pattern, settings.caustics.reflected, settings.sun

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it on the stone of the room."""
        return cls(site.settings, site.assets, site.elements[Room])

    def __init__(self, settings: Settings, assets: Assets, room: Room) -> None:
        """Upload the film and compile what the pool's light reaches; ``room`` draws the stone."""
        self.settings, self._room = settings, room
        self._possible = possible("caustics")
        frames = sines(FRAMES) if settings.caustics.pattern == "sines" else shipped(assets)
        self._film = MixedFilm(frames)
        # By material, bay and level of detail.
        self._lists: dict[tuple[str, int, int], DisplayList] = {}

        def meshes() -> dict[tuple[str, ...], Mesh]:
            lit = lit_meshes(direction(settings.sun))
            return {tuple(str(each) for each in key): mesh for key, mesh in lit}

        lit = kept_meshes(["the pool's light on the stone", repr(settings.sun)], meshes)
        for (material, bay, level), mesh in lit.items():
            mesh = brighter(mesh, settings.caustics.reflected)
            compiled = DisplayList(lambda mesh=mesh: draw_mesh(mesh))  # type: ignore[misc]
            self._lists[material, int(bay), int(level)] = compiled

    @property
    def in_one_pass(self) -> bool:
        """Whether the net is laid over the basin while that is drawn."""
        values = self.settings.caustics
        wanted = values.enabled and values.passes == "one"
        return wanted and self._possible and possible("caustics in one pass")

    @contextmanager
    def while_drawn(self, frame: Frame) -> Iterator[None]:
        """Let the block draw the basin with the net on it.

        With ``caustics.sunlit`` its alpha must be the sun's share of the light.
        """
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT):
            for unit in (FIRST_FREE + 1, FIRST_FREE):
                gl.glActiveTexture(texture_unit(unit))
                self._lay_net(frame, planes(self.settings))
            combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PREVIOUS"})
            combine({"COMBINE_ALPHA": "INTERPOLATE", "SRC0_ALPHA": "TEXTURE"})
            combine({"SRC1_ALPHA": "CONSTANT", "SRC2_ALPHA": "PREVIOUS"})
            self._set_neutral()
            gl.glActiveTexture(texture_unit(FIRST_FREE + 1))
            combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "PREVIOUS"})
            combine({"OPERAND1_RGB": "SRC_ALPHA", "COMBINE_ALPHA": "REPLACE"})
            if self.settings.caustics.doubled:
                gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)
            gl.glActiveTexture(gl.GL_TEXTURE0)
            yield

    def draw(self, frame: Frame) -> None:
        """Draw the second pass over the basin, and the light on the stone around the pool."""
        values = self.settings.caustics
        if not (self._possible and values.enabled):
            return
        groups = gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT
        with attrib(groups), front_faces():
            gl.glEnable(gl.GL_BLEND)
            gl.glDepthFunc(gl.GL_LEQUAL)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDisable(gl.GL_FOG)  # what is there is fogged already
            if not self.in_one_pass and not frame.mirrored:
                self._second_pass(frame)
            # Twice the fill, and hardly seen in the floor: the mirror image does without.
            if values.reflected > 0 and not frame.mirrored:
                self._reflected(frame)

    def _second_pass(self, frame: Frame) -> None:
        """Multiply the basin by the net."""
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT):
            doubled = self.settings.caustics.doubled
            gl.glBlendFunc(gl.GL_DST_COLOR if doubled else gl.GL_ZERO, gl.GL_SRC_COLOR)
            self._lay_net(frame, planes(self.settings))
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
            if self.settings.caustics.sunlit:
                gl.glActiveTexture(gl.GL_TEXTURE1)
                gl.glEnable(gl.GL_TEXTURE_2D)
                self._room.bind_light()
                combine({"COMBINE_RGB": "INTERPOLATE", "SRC0_RGB": "PREVIOUS"})
                combine(
                    {"SRC1_RGB": "CONSTANT", "SRC2_RGB": "TEXTURE", "OPERAND2_RGB": "SRC_ALPHA"}
                )
                self._set_neutral()
                gl.glActiveTexture(gl.GL_TEXTURE0)
            self._room.send("pool")

    def _reflected(self, frame: Frame) -> None:
        """Add stone times net times the light that reaches it from the pool."""
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT):
            gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonOffset(-1.0, -1.0)  # the meshes are finer than those drawn before
            gl.glDisable(gl.GL_LIGHTING)

            # Unit 0: the stone times the vertex's light; unit 1: times the net.
            gl.glActiveTexture(gl.GL_TEXTURE1)
            self._lay_net(frame, planes(self.settings, UPRIGHT) / np.float32(LARGER))
            combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"})
            gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 4.0)
            gl.glActiveTexture(gl.GL_TEXTURE0)
            gl.glEnable(gl.GL_TEXTURE_2D)
            for bay, level in self._room.levels(frame).items():
                for material in LIT:
                    if material == "vault" and not self.settings.room.vault:
                        continue
                    own = min(level, levels_of(material)[-1])
                    if compiled := self._lists.get((material, bay, own)):
                        self._room.texture(material).bind()
                        compiled.call()

    def _lay_net(self, frame: Frame, both: np.ndarray) -> None:
        """Let the active unit sample the net of the moment, laid by planes (2, 4)."""
        values = self.settings.caustics
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._film.bind(frame.kt / values.period, values.smooth)
        generate(both, values.planes)

    def _set_neutral(self) -> None:
        """Set the active unit's constant to the net that changes nothing."""
        neutral = 0.5 if self.settings.caustics.doubled else 1.0
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, np.full(4, neutral, np.float32))

    def release(self) -> None:
        """Delete the film and the lists; may be called twice."""
        self._film.release()
        for compiled in self._lists.values():
            compiled.release()
