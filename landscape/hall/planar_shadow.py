"""The shadows on floor and north wall, cast by the torch beside the pool and by the sun.

Technique: planar projected shadows ("glSkel, cast shadows"; Blinn 1988; Kilgard's dinoshade). The
statue is drawn a second time under the matrix M = (p . l) I - l p^T, which flattens it onto the
plane p along the rays of the light l; geometry/planar.py derives it. The plane's visible surface,
the receiver, is first marked in the stencil buffer (RECEIVER): drawn without colour where its depth
passes. Then, by ``shadow.method``:
- darken: the flattened statue blends black over marked pixels, and clears each mark as it does. It
  takes away a fraction of all light, and of what a polished floor mirrors. Where a mark is left,
  ``shadow.shine`` brightens the surface: so a torch that was moved lights what is around it. With
  ``shadow.lamp`` the torch is not a point: each of POINTS places of its flame takes its share away,
  so that the edge is the softer the farther away what casts it is.
- relight: the flattened statue only sets a bit of its light in the stencil buffer. Each part of the
  receiver, by its bits, is then drawn with the light map that lacks just these lights.
What casts them is the statue on its plinth and, by the torch alone and with ``shadow.casters=all``,
the pillars and the other torches (casters.py): the light map has their shadows of a torch on its
stand, but the torch may be moved (``shadow.flame``, in a walk by the mouse). What a moved torch
darkens is the plinth's top as well, whose light map has only the shadow by the sun.
State used: modelview, stencil bits RECEIVER and SHADED, blending, polygon offset, depth function
and mask.
What is wrong without its safeguards: without ``shadow.stencil`` each layer of the flattened statue
darkens again what another has darkened, and the shadow hangs in the air where the plane has no
surface, as in the rose window until the sky covers it. Without ``shadow.offset`` surface and shadow
have nearly the same depth and fight pixel by pixel; glPolygonOffset brings the shadow a little
nearer. Without ``shadow.behind`` the matrix is drawn with both signs, as by a program that divides
by w' itself and forgets its sign: what is higher than the torch then has an anti-shadow on the
floor, on the torch's other side; a torch between statue and wall (``shadow.flame``) throws it onto
the wall upside down; and a sun behind the wall casts shadows onto its inside.
``shadow.misprint`` draws by the matrix, or the equation of the plane, as the document prints it.
A planar shadow falls on planes alone: pillars and vault receive none. That of a point is hard.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import combinations
from typing import NamedTuple

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import drawing, gl
from framelens.gl.state import attrib, front_faces, matrix
from framelens.gl.texture import Texture
from landscape.elements import sun
from landscape.elements.element import Element
from landscape.frame import Frame
from landscape.geometry.planar import misprinted_matrix, shadows_of
from landscape.gl.accumulating import disc
from landscape.hall import plan
from landscape.hall.exhibits.picture import Part, draw_within, part_of_polygon
from landscape.hall.mirror import FLOOR
from landscape.hall.settings import Settings, Shadow

RECEIVER = 2  # the stencil bit of the surface that receives a shadow
SHADED = {"sun": 4, "torch": 8}  # those of what a light does not reach
ALL = RECEIVER | sum(SHADED.values())
FLOOR_PLANE = np.array([0.0, 1.0, 0.0, 0.0])
NORTH_PLANE = np.array([0.0, 0.0, 1.0, -plan.INSIDE.north])
PLINTH_PLANE = np.array([0.0, 1.0, 0.0, -plan.PLINTH[1]])
POINTS = 15  # chosen: of a lamp that is not a point
OFFSET = -2.0, -4.0  # the document has -2, -1; more units, as the shadow's triangles are long
MARGIN = 1e-6  # units: shadows lie on the plane but for rounding
FAR_AWAY = 1e3  # chosen: units, beyond any receiver
SIDE, WIDE = 128, 4.0  # chosen: of the texture of a flame's light: texels, and half its width
FIRELIGHT = (1.0, 0.82, 0.58)  # chosen: RGB
WAVER = ((0.61, 0.9), (0.37, 0.7), (0.83, 1.0))  # chosen: turns per kt; strength along x, y, z


def flame(kt: float, shadow: Shadow) -> np.ndarray:
    """Return where the torch shines from at ``kt``, (4,): its flame, which wavers."""
    moved = [
        amplitude * (math.sin(turn * kt + 2.0 * k) + math.sin(0.43 * turn * kt + k)) / 2
        for k, (turn, amplitude) in enumerate(WAVER)
    ]
    return np.array([*shadow.flame, 1.0]) + shadow.flicker * np.array([*moved, 0.0])


class Receiver(NamedTuple):
    """A surface that receives shadows: its plane, two corners of a box around it, its triangles.

    ``send`` sends the triangles that face the viewer.
    """

    name: str
    plane: np.ndarray
    corners: np.ndarray
    send: Callable[[], None]


def on_floor(send: Callable[[], None]) -> Receiver:
    """Return the floor as a receiver."""
    inside = plan.INSIDE
    corners = [[inside.west, 0.0, inside.north], [inside.east, 0.0, inside.south]]
    return Receiver("floor", FLOOR_PLANE, np.array(corners), send)


def on_north(send: Callable[[], None]) -> Receiver:
    """Return the north wall as a receiver."""
    inside = plan.INSIDE
    corners = [[inside.west, 0.0, inside.north], [inside.east, plan.CROWN, inside.north]]
    return Receiver("north", NORTH_PLANE, np.array(corners), send)


def on_plinth(send: Callable[[], None]) -> Receiver:
    """Return the top of the plinth as a receiver."""
    (x, z), (half, top) = plan.STATUE, plan.PLINTH
    corners = [[x - half, top, z - half], [x + half, top, z + half]]
    return Receiver("plinth", PLINTH_PLANE, np.array(corners), send)


def places(light: np.ndarray, radius: float, count: int) -> np.ndarray:
    """Return points (``count``, 4) that a lamp around a light (4,) shines from, on a level disc."""
    found = np.repeat(light[None], count, axis=0)
    if count > 1:
        found[:, [0, 2]] += radius * disc(count)
    return found


def has_alpha() -> bool:
    """Return whether the picture keeps alpha, in which the points of a lamp are counted."""
    return int(gl.glGetIntegerv(gl.GL_ALPHA_BITS)) > 0


def reached(points: np.ndarray, receiver: Receiver, light: np.ndarray) -> np.ndarray | None:
    """Return two corners (2, 3) of the part of a receiver that shadows of a box may reach.

    ``points`` (n, 3) are the box's corners. None if the shadows miss the receiver.
    """
    shadows = shadows_of(points, receiver.plane, light)
    endless = np.isnan(shadows).any(axis=1)
    if endless.all():
        return None
    if endless.any():
        # What is as far from the plane as the light has its shadow infinitely far away from it.
        normal = receiver.plane[:3]
        away = points[endless] - light[:3]
        away -= np.outer(away @ normal, normal)
        shadows[endless] = points[endless] + FAR_AWAY * away
    low = np.maximum(shadows.min(axis=0), receiver.corners[0] - MARGIN)
    high = np.minimum(shadows.max(axis=0), receiver.corners[1] + MARGIN)
    return np.stack([low, high]) if (low <= high).all() else None


def rectangle(ends: np.ndarray, plane: np.ndarray) -> np.ndarray:
    """Return the corners (4, 3), one after the other, of a rectangle, level or on NORTH_PLANE.

    ``ends`` (2, 3) are two that face each other.
    """
    (low, high), (across, up) = ends, (0, 2) if plane[1] else (0, 1)
    found = np.tile((low + high) / 2, (4, 1))
    found[:, across] = np.array([low, high, high, low])[:, across]
    found[:, up] = np.array([low, low, high, high])[:, up]
    return found


def glow_image() -> np.ndarray:
    """Return how a flame lights a plane, uint8 (SIDE, SIDE, 1), 255 at its foot.

    By the cosine and the square of the distance; the image is 2 WIDE heights of the flame wide, and
    black at its rim.
    """
    along = ((np.arange(SIDE) + 0.5) / SIDE * 2 - 1) * WIDE
    away = np.hypot(along[:, None], along[None, :])
    least = (1.0 + WIDE**2) ** -1.5
    light = np.maximum((1.0 + away**2) ** -1.5 - least, 0.0) / (1.0 - least)
    light[[0, -1], :] = light[:, [0, -1]] = 0.0
    return np.rint(255.0 * light)[..., None].astype(np.uint8)


def corners_of(box: np.ndarray) -> np.ndarray:
    """Return the eight corners (8, 3) of a box, of which two (2, 3) are given."""
    return np.array(
        [[box[i][0], box[j][1], box[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    )


INSIDE = plan.INSIDE
WHOLE = corners_of(
    np.array([[INSIDE.west, 0.0, INSIDE.north], [INSIDE.east, plan.SPRINGING, INSIDE.south]])
)


class PlanarShadow(Element[Settings]):
    """The shadows of what ``cast`` sends."""

    def __init__(
        self, settings: Settings, cast: Callable[[Frame, str, str], None], box: np.ndarray
    ) -> None:
        """Take the function that sends what casts a light's shadows on a receiver.

        The light is "sun" or "torch". ``box`` has two corners of that of the statue.
        """
        self.settings, self._cast = settings, cast
        self._box = corners_of(box)
        self._light: Texture | None = None

    @property
    def relights(self) -> bool:
        """Whether receivers are drawn again without a light; only a stencil makes that possible."""
        return self.settings.shadow.method == "relight" and self.settings.shadow.stencil

    def lights(self, frame: Frame, receiver: Receiver) -> dict[str, tuple[np.ndarray, Part | None]]:
        """Return the lights, each (4,), that may cast shadows on a receiver in view, by name.

        Beside each is the part of the picture that its shadow is in, None for all of it.
        """
        wanted = self.settings.shadow
        found = {}
        if wanted.light in ("sun", "both"):
            found["sun"] = np.append(sun.direction(self.settings.sun), 0.0)
        if wanted.light in ("torch", "both"):
            found["torch"] = flame(frame.kt, wanted)
        if not wanted.behind:
            return {name: (light, None) for name, light in found.items()}
        seen: dict[str, tuple[np.ndarray, Part | None]] = {}
        for name, light in found.items():
            all_of_it = wanted.casters == "all" and name == "torch"
            box = WHOLE if all_of_it else self._box
            if (corners := reached(box, receiver, light)) is not None:
                outline = rectangle(corners, receiver.plane)
                if part := part_of_polygon(frame, outline):
                    seen[name] = light, part

        return seen

    def darken(self, frame: Frame, receiver: Receiver) -> None:
        """Darken a receiver that has been drawn where the lights' rays do not reach it."""
        values = self.settings.shadow
        inside = self._inside(frame)
        with self._shadowing():
            gl.glEnable(gl.GL_BLEND)
            for name, (light, _) in self.lights(frame, receiver).items():
                if name == "torch" and values.lamp and values.stencil and has_alpha():
                    self._soften(frame, receiver, inside, light)
                    continue
                if values.stencil:
                    self._mark(inside, receiver)
                    self._pass_marked(inside, gl.GL_ZERO)
                    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
                gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
                gl.glColor4f(0.0, 0.0, 0.0, values.strength)
                self._flatten(frame, receiver, light, name)
                if name == "torch" and values.stencil:
                    self._shine(inside, receiver, light)
        # In Mesa glPopAttrib does not restore a colour that nothing was drawn with.
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def _soften(self, frame: Frame, receiver: Receiver, inside: int, light: np.ndarray) -> None:
        """Darken a receiver by a lamp that is not a point, of which it may be lit in part.

        Destination alpha counts: each point that does not reach a pixel adds its share. Then one
        pass takes that fraction of the light away. To darken colours once a point would round them
        as often, to bands of wrong hues. A walk on a slow machine takes fewer points.
        """
        count = max(1, round(POINTS / frame.detail.coarser))
        self._mark(inside, receiver)
        gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
        self._shine(inside, receiver, light)

        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_TRUE)
        self._cover(inside, receiver, 0.0)
        for point in places(light, self.settings.shadow.lamp, count):
            self._mark(inside, receiver)
            self._pass_marked(inside, gl.GL_ZERO)
            gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_TRUE)
            gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
            gl.glColor4f(0.0, 0.0, 0.0, self.settings.shadow.strength / count)
            self._flatten(frame, receiver, point, "torch")
            gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
        self._take_away(inside, receiver)

    def _take_away(self, inside: int, receiver: Receiver) -> None:
        """Take from a receiver the fraction of its light that destination alpha says."""
        self._mark(inside, receiver)
        self._pass_marked(inside, gl.GL_KEEP)
        gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_FALSE)
        gl.glBlendFunc(gl.GL_ZERO, gl.GL_ONE_MINUS_DST_ALPHA)
        receiver.send()
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_TRUE)
        self._cover(inside, receiver, 1.0)

    def _cover(self, inside: int, receiver: Receiver, alpha: float) -> None:
        """Write an alpha where the receiver is marked."""
        self._pass_marked(inside, gl.GL_KEEP)
        gl.glBlendFunc(gl.GL_ONE, gl.GL_ZERO)
        gl.glColor4f(0.0, 0.0, 0.0, alpha)
        receiver.send()

    @staticmethod
    def _pass_marked(inside: int, then: int) -> None:
        """Draw where the receiver is marked, and do with the mark what ``then`` says."""
        gl.glStencilFunc(gl.GL_EQUAL, inside | RECEIVER, inside | RECEIVER)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, then)

    def _shine(self, inside: int, receiver: Receiver, light: np.ndarray) -> None:
        """Brighten what is level around the torch where its mark is left: where no shadow lies.

        GL_DST_COLOR, GL_ONE adds what is there to itself, times a texture of the light. The wall is
        bright enough already, by the torch's own bowl.
        """
        strength = self.settings.shadow.shine
        x, _, z = light[:3].tolist()
        height = float(receiver.plane @ light)
        if not strength or height <= 0.0 or not receiver.plane[1]:
            return
        with attrib(gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT):
            gl.glBlendFunc(gl.GL_DST_COLOR, gl.GL_ONE)
            gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
            self._pass_marked(inside, gl.GL_KEEP)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._glow().bind()
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
            wide = 2.0 * WIDE * height
            planes = (1.0, 0.0, 0.0, wide / 2 - x), (0.0, 0.0, 1.0, wide / 2 - z)
            for name, plane in zip("ST", planes, strict=True):
                coordinate = gl_constant(f"GL_{name}")
                gl.glTexGeni(coordinate, gl.GL_TEXTURE_GEN_MODE, gl.GL_OBJECT_LINEAR)
                gl.glTexGenfv(coordinate, gl.GL_OBJECT_PLANE, np.array(plane, np.float32) / wide)
                gl.glEnable(gl_constant(f"GL_TEXTURE_GEN_{name}"))

            gl.glColor3f(*(strength * each for each in FIRELIGHT))
            receiver.send()

    def _glow(self) -> Texture:
        """Return the texture of a flame's light on a plane, made when it is first needed."""
        if self._light is None:
            self._light = Texture(glow_image(), repeat=False, mipmaps=False)
        return self._light

    def parts(self, frame: Frame, receiver: Receiver) -> Iterator[tuple[str, ...]]:
        """Divide a receiver by its shadows; yield the names of the lights that each part lacks.

        What is drawn until the next step shows in that part alone. The first lacks none.
        """
        inside, lights = self._inside(frame), self.lights(frame, receiver)
        if not lights:
            yield ()
            return
        with self._shadowing():
            self._mark(inside, receiver)
            for name, (light, _) in lights.items():
                bit = SHADED[name]
                gl.glStencilMask(bit)
                gl.glStencilFunc(gl.GL_EQUAL, inside | RECEIVER | bit, inside | RECEIVER)
                self._flatten(frame, receiver, light, name)

        groups = gl.GL_ENABLE_BIT | gl.GL_STENCIL_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        with attrib(groups | gl.GL_SCISSOR_BIT):
            gl.glEnable(gl.GL_STENCIL_TEST)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
            gl.glDepthFunc(gl.GL_LEQUAL)
            for count in range(len(lights) + 1):
                for without in combinations(lights, count):
                    if not restrict(frame, [lights[name][1] for name in without]):
                        continue
                    bits = inside | RECEIVER | sum(SHADED[name] for name in without)
                    gl.glStencilFunc(gl.GL_EQUAL, bits, inside | ALL)
                    yield without

    def _inside(self, frame: Frame) -> int:
        """Return the bit that pixels must have: in a mirror image, where the floor is visible."""
        return FLOOR if frame.mirrored and self.settings.mirror.stencil else 0

    @contextmanager
    def _shadowing(self) -> Iterator[None]:
        """Let shadows be drawn without a depth of their own."""
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
        groups |= gl.GL_STENCIL_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT
        with drawing("shadow"), attrib(groups):
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDepthFunc(gl.GL_LEQUAL)
            yield

    @staticmethod
    def _mark(inside: int, receiver: Receiver) -> None:
        """Mark where the receiver is visible, and forget former shadows on it.

        Only inside _shadowing(); colour stays masked.
        """
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilMask(ALL)
        gl.glStencilFunc(gl.GL_EQUAL, inside | RECEIVER, inside)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
        receiver.send()

    def _flatten(self, frame: Frame, receiver: Receiver, light: np.ndarray, name: str) -> None:
        """Send what casts a light's shadows, flattened onto the plane along its rays."""
        values = self.settings.shadow
        if values.offset:
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonOffset(*OFFSET)
        flattened = misprinted_matrix(receiver.plane, light, values.misprint)
        for signed in (flattened,) if values.behind else (flattened, -flattened):
            # What faces the light has the same shadow as the whole, of half the triangles.
            with matrix(), front_faces():
                gl.glMultMatrixf(np.ascontiguousarray(signed.T, np.float32))
                self._cast(frame, name, receiver.name)

    def release(self) -> None:
        """Delete the texture, if there is one; may be called twice."""
        if self._light is not None:
            self._light.release()


def restrict(frame: Frame, parts: Sequence[Part | None]) -> bool:
    """Draw only where all of these parts of the picture are; False if they have none in common."""
    known = [each for each in parts if each]
    if not known:
        return True
    x, y = max(each.x for each in known), max(each.y for each in known)
    width = min(each.x + each.width for each in known) - x
    height = min(each.y + each.height for each in known) - y
    if width <= 0 or height <= 0:
        return False
    draw_within(frame, x, y, width, height)
    return True
