"""An armillary sphere before a large lamp, and its soft shadow (SIGGRAPH 1997, soft shadows).

Technique: a lamp that is not a point is taken as many points, each of which throws a hard shadow;
the mean of these is soft (Heckbert and Herf 1997). Pedestal and back wall each have a texture: for
each point of the lamp the model is flattened onto the plane by the planar shadow matrix, and drawn
in black on white, seen from straight above the plane; the accumulation buffer holds the mean
(accumulation.py). The textures then darken the stone: GL_BLEND mixes the shade's colour and white
by the texture, and glBlendFunc(GL_ZERO, GL_SRC_COLOR) multiplies. Neither lamp nor model moves, so
the textures are made once; they cost nothing afterwards.
What is wrong without enough points: with one the shadow is hard, with a few one sees each.
Near the model's foot the shadow is sharp, and it softens with the distance, as it should.
State used: GL_TEXTURE_2D, GL_BLEND, GL_LIGHT2, the accumulation's.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from framelens.gl.texture import Texture
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh, merged, revolve
from landscape.geometry.planar import shadow_matrix
from landscape.gl.accumulating import disc
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.hall import plan
from landscape.hall.exhibits.accumulation import Accumulation
from landscape.hall.exhibits.exhibit import Exhibit
from landscape.hall.exhibits.niche import (
    INSET,
    MIDDLE,
    SOFT,
    TOP,
    lamp,
    lit_by,
    pedestal_top,
    shiny,
)
from landscape.hall.settings import Settings

TEXELS = 256  # chosen: side of a receiver's texture
SHADE = (0.24, 0.26, 0.32)  # chosen: what is left of the light in the full shadow
BRASS = (0.85, 0.62, 0.26)  # chosen
GLASS, IRON = (1.0, 0.93, 0.74), (0.10, 0.09, 0.08)  # chosen: the lamp, and what it hangs on
RING, THICK = 0.038, 0.0022  # chosen: radius of the rings and of their rods, units
HEIGHT = TOP + 0.064  # of the rings' middle
LIFT = 0.0004  # chosen: units between a receiver and what darkens it


class Receiver(NamedTuple):
    """A rectangle in a plane: a corner and two sides, (3,) each, at right angles."""

    corner: np.ndarray
    along: np.ndarray
    up: np.ndarray

    @property
    def plane(self) -> np.ndarray:
        """Its plane (4,): 0 on it, above 0 where ``along`` x ``up`` points."""
        normal = np.cross(self.along, self.up)
        normal = normal / np.linalg.norm(normal)
        return np.array([*normal, -float(normal @ self.corner)])

    def flattened(self, light: np.ndarray) -> np.ndarray:
        """Return the matrix (4, 4) that throws a shadow onto it, as clip coordinates of it alone.

        ``light`` (3,) is a point in front of it.
        """
        view = np.eye(4)
        for row, side in ((0, self.along), (1, self.up)):
            square = float(side @ side)
            view[row, :3] = 2 * side / square
            view[row, 3] = -2 * float(side @ self.corner) / square - 1
        view[2] = 0.0
        return np.asarray(view @ shadow_matrix(self.plane, np.array([*light, 1.0])))


def receivers() -> tuple[Receiver, Receiver]:
    """Return the top of the pedestal and the back wall."""
    z, half = plan.ALCOVES[SOFT], plan.ALCOVE_HALF
    west, east, wide = pedestal_top(SOFT)
    back = plan.INSIDE.west - plan.ALCOVE_DEPTH + INSET
    top = Receiver(
        np.array([east, TOP, z + wide]),
        np.array([0.0, 0.0, -2 * wide]),
        np.array([west - east, 0, 0]),
    )
    wall = Receiver(
        np.array([back, 0.0, z + half]),
        np.array([0.0, 0.0, -2 * half]),
        np.array([0.0, plan.ALCOVE_TOP, 0.0]),
    )
    return top, wall


def ring(axis: np.ndarray, radius: float) -> Mesh:
    """Return a ring around the origin, turned about a unit vector (3,)."""
    other = np.cross(axis, (0.0, 1.0, 0.0) if abs(axis[1]) < 0.9 else (1.0, 0.0, 0.0))
    other /= np.linalg.norm(other)
    third = np.cross(axis, other)

    long, short = 48, 8
    u = (np.arange(long) / long * 2 * np.pi)[:, None, None]
    v = (np.arange(short) / short * 2 * np.pi)[None, :, None]
    out = np.cos(u) * other + np.sin(u) * third
    normals = (np.cos(v) * out + np.sin(v) * axis).reshape(-1, 3)
    vertices = (radius * out + THICK * (np.cos(v) * out + np.sin(v) * axis)).reshape(-1, 3)

    k, j = (each.ravel() for each in np.mgrid[:long, :short])
    after, beside = (k + 1) % long, (j + 1) % short
    a, b = k * short + j, after * short + j
    c, d = after * short + beside, k * short + beside
    triangles = np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)
    return Mesh(
        vertices.astype(np.float32),
        normals.astype(np.float32),
        triangles.astype(np.uint32),
        (np.zeros((len(vertices), 2), np.float32),),
    )


def armillary() -> Mesh:
    """Return the rings, their globe and their foot, standing at the origin."""
    tilt = np.radians(23.4)  # of the ecliptic
    pole = np.array([0.0, np.cos(tilt), np.sin(tilt)])
    axes = [np.array([0.0, 1.0, 0.0]), pole, np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])]
    rings = [ring(axis, RING - 0.0035 * number) for number, axis in enumerate(axes)]
    centre = HEIGHT - TOP
    foot = [
        (0.021, 0.0),
        (0.020, 0.004),
        (0.010, 0.008),
        (0.006, 0.012),
        (0.003, 0.016),
        (0.0035, centre - RING),
    ]
    ball = globe(0.010)
    lifted = np.array([0.0, centre, 0.0], np.float32)
    moved = [replace(each, vertices=each.vertices + lifted) for each in rings]
    return merged(
        [*moved, replace(ball, vertices=ball.vertices + lifted), revolve(foot, 20, (1.0, 1.0))]
    )


class SoftShadow(Exhibit):
    """The armillary sphere, its lamp and its shadow."""

    def __init__(self, settings: Settings, assets: Assets, accumulation: Accumulation | None):
        """Compile the model; without ``accumulation`` it has no shadow."""
        self.settings, self._accumulation = settings, accumulation
        mesh, bulb = armillary(), globe(settings.exhibits.soft_lamp)
        iron = holder(settings.exhibits.soft_lamp)
        self._place = MIDDLE, TOP, plan.ALCOVES[SOFT]
        self._list = DisplayList(lambda: draw_mesh(mesh))
        self._bulb = DisplayList(lambda: draw_mesh(bulb))
        self._holder = DisplayList(lambda: draw_mesh(iron))
        blank = np.full((TEXELS, TEXELS, 3), 255, np.uint8)
        self.textures = [Texture(blank, repeat=False, mipmaps=False) for _ in receivers()]
        self._made_for: tuple[object, ...] = ()

    def points(self) -> np.ndarray:
        """Return points of the lamp, (n, 3), on a disc that faces the model."""
        values = self.settings.exhibits
        centre = np.array(lamp(SOFT))
        towards = np.array(self._place) + (0.0, HEIGHT - TOP, 0.0) - centre
        across = np.cross(towards, (0.0, 1.0, 0.0))
        above = np.cross(across, towards)
        sides = np.stack([each / np.linalg.norm(each) for each in (across, above)])
        return np.asarray(centre + values.soft_lamp * disc(values.soft_samples) @ sides)

    def _make(self, accumulation: Accumulation) -> None:
        """Make the textures of both receivers."""
        points = self.points() if self.settings.exhibits.soft_samples > 1 else [lamp(SOFT)]
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT

        def draw(number: int) -> None:
            with attrib(groups), matrix():
                gl.glLoadIdentity()
                gl.glDisable(gl.GL_DEPTH_TEST)
                gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)  # a wireframe has it, too
                gl.glColor4f(0.0, 0.0, 0.0, 1.0)
                gl.glTranslatef(*self._place)
                self._list.call()

        for texture, receiver in zip(self.textures, receivers(), strict=True):
            thrown = [receiver.flattened(np.asarray(point)) for point in points]
            accumulation.gather((TEXELS, TEXELS), thrown, draw, (1.0, 1.0, 1.0, 1.0))
            with accumulation.mean.drawing(clear=False):
                texture.bind()
                gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, TEXELS, TEXELS)
                gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def draw_plain(self, frame: Frame) -> None:
        """Draw model and lamp without the shadow."""
        with lit_by(lamp(SOFT)):
            gl.glColor3f(*BRASS)
            shiny(0.9, 40.0)
            with matrix():
                gl.glTranslatef(*self._place)
                self._list.call()
            gl.glColor3f(*IRON)
            with matrix():
                gl.glTranslatef(*lamp(SOFT))
                self._holder.call()
                gl.glDisable(gl.GL_LIGHTING)
                gl.glColor3f(*GLASS)
                self._bulb.call()

    def draw(self, frame: Frame) -> None:
        """Draw the shadow on the stone, the model and the lamp."""
        values = self.settings.exhibits
        if self._accumulation is not None:
            wanted = values.soft_samples, values.deep
            if wanted != self._made_for:
                self._make(self._accumulation)
                self._made_for = wanted
            self._darken()
        self.draw_plain(frame)

    def _darken(self) -> None:
        """Multiply the stone by the shade where the lamp is hidden."""
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT
        with attrib(groups | gl.GL_DEPTH_BUFFER_BIT):
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_ZERO, gl.GL_SRC_COLOR)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_BLEND)
            white = np.ones(4, np.float32)
            gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, white)
            gl.glColor3f(*SHADE)
            for texture, receiver in zip(self.textures, receivers(), strict=True):
                texture.bind()
                corner = receiver.corner + LIFT * receiver.plane[:3]
                gl.glBegin(gl.GL_QUADS)
                for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    gl.glTexCoord2f(float(s), float(t))
                    gl.glVertex3f(*(corner + s * receiver.along + t * receiver.up).tolist())
                gl.glEnd()

        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def release(self) -> None:
        """Delete lists and textures; may be called twice."""
        self._list.release()
        self._bulb.release()
        self._holder.release()
        for texture in self.textures:
            texture.release()


def globe(radius: float) -> Mesh:
    """Return a small sphere around the origin."""
    turn = np.linspace(-np.pi / 2, np.pi / 2, 13)
    profile = [(radius * float(np.cos(a)), radius * float(np.sin(a))) for a in turn]
    return revolve(profile, 20, (1.0, 1.0))


def holder(radius: float) -> Mesh:
    """Return the cap of a lamp around the origin and the rod that it hangs on."""
    cap = [
        (0.75 * radius, 0.66 * radius),
        (0.8 * radius, 0.7 * radius),
        (0.3 * radius, 1.1 * radius),
    ]
    rod = [(0.0012, 1.1 * radius), (0.0012, plan.ALCOVE_TOP - lamp(SOFT)[1])]
    return merged([revolve(cap, 16, (1.0, 1.0)), revolve(rod, 6, (1.0, 1.0))])
