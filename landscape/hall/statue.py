"""The statue: the sea dragon, in bronze, on its plinth, or a ball of metal (``statue.figure``).

A ball mirrors the hall as one piece, so that one recognises it: the dragon's scales break it up.
Technique: a lit mesh in a display list, or from afar a simpler one (vertex clustering). It is also
the mask for a change of tone. It is gilded: environment.py draws what it mirrors. Its mirror image
is a coarser mesh of side 2, which glScalef brings to its size: that scales the normals, too, and
GL_NORMALIZE makes them unit vectors again. Its shadows are those of meshes coarser still.
The colours of its vertices are the gold's, dimmed where little of the hall's soft light arrives
(statue_light.py): between its loops, over the plinth, and on the side that turns from the windows.
Two lights shine on it: the sun, and the torch beside the pool, a point light that is weaker the
farther away, and wavers.
State used: lighting, the material, culling, GL_NORMALIZE.
"""

import math
from collections.abc import Callable, Hashable
from dataclasses import replace
from functools import partial

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, front_faces, glint_after_texture, matrix
from landscape.elements.animal import read_animal
from landscape.elements.element import Element
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.frame import Frame
from landscape.geometry.clustering import clustered
from landscape.geometry.culling import ball_in_view
from landscape.geometry.mesh import Mesh, gathered, grid_triangles, scaled
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.features import possible
from landscape.hall import plan
from landscape.hall.environment import Environment
from landscape.hall.planar_shadow import flame
from landscape.hall.settings import Settings
from landscape.hall.statue_light import soft_light

BRONZE = (0.72, 0.50, 0.22)  # chosen
SOFT = 0.60  # chosen: the hall's soft light, as ambient light, beside the sun's own
FIRE, REACH = (0.9, 0.62, 0.34), 1.0  # chosen: RGB of the torch's light; units to half of it
GLINT, SHININESS = (0.5, 0.42, 0.26, 1.0), 60.0  # chosen
# Chosen: sides of the cubes whose vertices are merged, of a mesh of 2: for its image, and for its
# shadows, from afar and from nearby.
COARSE = 0.025
COARSEST = 0.045
COARSER = 0.03
FROM_AFAR = 0.0125, 0.02  # chosen: the same for the statue itself from afar
BALL_GRID = 64, 128  # chosen: rows and columns of the ball
SHARP = (
    512  # chosen: texels of what a ball mirrors: a side of a face of the cube map, and of the map
)
PIXELS = 2.0  # chosen: how many pixels such a cube may be wide


def standing(unit: Mesh) -> tuple[np.ndarray, np.ndarray, float]:
    """Return vertices and normals (n, 3) of a mesh turned as the statue, and its plinth's top.

    The mesh is 2 units long.
    """
    turn = math.radians(plan.STATUE_YAW)
    c, s = math.cos(turn), math.sin(turn)
    turned = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    low = float(unit.vertices[:, 1].min()) + plan.STATUE_SUNK / plan.STATUE_SCALE
    return unit.vertices @ turned.T, unit.normals @ turned.T, low


def ball() -> Mesh:
    """Return a ball around the origin, of as many triangles as its image needs."""
    rows, columns = BALL_GRID
    down, around = np.linspace(0.0, np.pi, rows + 1), np.linspace(0.0, 2 * np.pi, columns + 1)
    theta, phi = (grid.ravel() for grid in np.meshgrid(down, around, indexing="ij"))
    level = np.sin(theta)
    normals = np.stack([level * np.cos(phi), np.cos(theta), -level * np.sin(phi)], axis=1)
    unit = np.ascontiguousarray(normals, np.float32)
    return Mesh(plan.BALL * unit, unit, grid_triangles(columns + 1, rows + 1))


def cast_in(mesh: Mesh, metal: tuple[float, ...], shaded: bool) -> Mesh:
    """Return a mesh in the colour of a metal, if ``shaded`` times its own, uint8 (n, 1)."""
    assert mesh.colors is not None
    light = mesh.colors if shaded else np.full_like(mesh.colors, 255)
    colors = np.ascontiguousarray(np.rint(light * np.array(metal)), np.uint8)
    return replace(mesh, colors=colors)


class Statue(Element[Settings]):
    """The statue."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return what the constructor uses of the settings."""
        return settings.statue.figure

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the mesh and compile its display list."""
        self.settings = settings
        self._figure = settings.statue.figure
        round_ = self._figure == "ball"
        unit = ball() if round_ else read_animal(assets, "dragon.ply", "dragon.mesh")

        def soft() -> tuple[np.ndarray, ...]:
            light = np.clip(soft_light(*standing(unit)), 0.0, 1.0)
            return (np.rint(255 * light[:, None]).astype(np.uint8),)

        files = assets.contents("dragon.ply")
        light = recall(["the statue's soft light", str(self._figure), *files], soft)[0]
        unit = replace(unit, colors=light)
        mesh = scaled(gathered(unit), plan.STATUE_SCALE)
        sides = COARSE, COARSER, COARSEST
        coarse, coarser, coarsest = (gathered(clustered(unit, cell)) for cell in sides)
        lowest = float(mesh.vertices[:, 1].min())
        (x, z), (_, top) = plan.STATUE, plan.PLINTH
        foot = top - plan.STATUE_SUNK - lowest
        self._place = self.middle = x, foot, z
        reach = float(np.abs(mesh.vertices[:, [0, 2]]).max())
        # Corners of a box around statue and plinth, whichever way the statue is turned.
        height = foot + float(mesh.vertices[:, 1].max())
        self.box = np.array([[x - reach, 0.0, z - reach], [x + reach, height, z + reach]])
        self._environment: Environment | None = None
        # A mirror ball of fewer vertices would distort what it mirrors.
        afar = [unit if round_ else clustered(unit, cell) for cell in FROM_AFAR]
        simpler = [scaled(gathered(each), plan.STATUE_SCALE) for each in afar]
        # Their colours are the soft light; the last is the image's.
        self._meshes = mesh, *simpler, coarse
        self._metal: tuple[float, ...] = ()
        self._lists: list[DisplayList] = []
        self._compile()
        casting = (replace(each, colors=None) for each in (gathered(afar[0]), coarser, coarsest))
        self._finest, self._coarser, self._coarsest = (
            DisplayList(partial(draw_mesh, each)) for each in casting
        )

    @property
    def _gilded(self) -> bool:
        return self._environment is not None and self.settings.statue.environment != "none"

    def _compile(self) -> None:
        """Compile the meshes in the colours of the metal, if it has changed."""
        metal = tuple(self.settings.statue.gold) if self._gilded else BRONZE
        if metal == self._metal:
            return
        self._metal = metal
        for each in self._lists:
            each.release()
        coloured = [cast_in(mesh, metal, self._gilded) for mesh in self._meshes]
        self._lists = [DisplayList(partial(draw_mesh, mesh)) for mesh in coloured]
        self._list = self._lists[0]

    def take(self, settings: Settings) -> None:
        """Take other settings, and the metal that they ask for."""
        self.settings = settings
        if self._environment is not None:
            self._environment.settings = settings
        self._compile()

    def gild(self, draw: Callable[[Frame], None]) -> None:
        """Let the statue mirror what ``draw`` draws around it, where this OpenGL can."""
        if possible("statue.environment"):
            sides = (SHARP,) * 2 if self._figure == "ball" else ()
            self._environment = Environment(self.settings, self.middle, draw, *sides)
            self._compile()

    def draw(self, frame: Frame) -> None:
        """Draw the statue, lit."""
        if not self._in_view(frame):
            return
        if not frame.mirrored:
            self._list = self._level_for(frame)
        if self._environment is not None:
            self._environment.prepare(frame)
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT
        with attrib(groups), front_faces():
            gl.glEnable(gl.GL_LIGHTING)
            gl.glEnable(gl.GL_COLOR_MATERIAL)
            self._light(frame)
            if frame.mirrored and self.settings.mirror.normals:
                gl.glEnable(gl.GL_NORMALIZE)
            send = self.send_coarse if frame.mirrored else self.send
            if self._gilded and self._environment is not None:
                self._polish()
                with self._environment.mirrored_by(frame):
                    send()
            else:
                send()

        # In Mesa glPopAttrib does not restore the colour here.
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def _in_view(self, frame: Frame) -> bool:
        """Return whether the statue, or its mirror image, may be in view."""
        low, high = self.box
        x, y, z = ((low + high) / 2).tolist()
        return ball_in_view(frame, (x, -y if frame.mirrored else y, z), math.dist(low, high) / 2)

    def _level_for(self, frame: Frame) -> DisplayList:
        """Return the simplest mesh that is good enough for a frame."""
        cell = PIXELS * math.dist(frame.eye, self.middle) / frame.pixels / plan.STATUE_SCALE
        return self._lists[sum(each <= cell for each in FROM_AFAR)]

    def _light(self, frame: Frame) -> None:
        """Set what lights the statue besides the sun: the hall, and the torch beside the pool."""
        if self._gilded:
            gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, np.array([SOFT] * 3 + [1.0], np.float32))
        fire = np.array([*FIRE, 1.0], np.float32)
        gl.glEnable(gl.GL_LIGHT2)
        gl.glLightfv(gl.GL_LIGHT2, gl.GL_DIFFUSE, fire)
        gl.glLightfv(gl.GL_LIGHT2, gl.GL_SPECULAR, fire)
        gl.glLightf(gl.GL_LIGHT2, gl.GL_QUADRATIC_ATTENUATION, REACH**-2)
        place = flame(frame.kt, self.settings.shadow)
        gl.glLightfv(gl.GL_LIGHT2, gl.GL_POSITION, place.astype(np.float32))

    @staticmethod
    def _polish() -> None:
        """Set a metal's material: it glints.

        The glint is added after the texture, by GL_SEPARATE_SPECULAR_COLOR where there is one.
        """
        glint_after_texture()
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_SPECULAR, np.array(GLINT, np.float32))
        gl.glMaterialf(gl.GL_FRONT, gl.GL_SHININESS, SHININESS)

    def send(self) -> None:
        """Send the mesh that was drawn last at its place, whatever the state."""
        with matrix():
            gl.glTranslatef(*self._place)
            gl.glRotatef(plan.STATUE_YAW, 0.0, 1.0, 0.0)
            self._list.call()

    def send_coarse(self) -> None:
        """Send a coarser mesh at its place, its normals longer than 1."""
        self._send_scaled(self._lists[-1])

    def send_shadowing(self, frame: Frame) -> None:
        """Send the mesh that casts the shadows at its place.

        A lamp that is carried (``shadow.casters=all``) comes so close that the shadow is much
        larger than the statue: it needs a finer mesh, if its edges are not soft.
        """
        values = self.settings.shadow
        carried = values.casters == "all"
        near = frame.pose.z < plan.STATUE[1]  # on the side of the wall that it falls on
        mesh = self._coarser if near or carried else self._coarsest
        self._send_scaled(self._finest if carried and not values.lamp else mesh)

    def _send_scaled(self, mesh: DisplayList) -> None:
        with matrix():
            gl.glTranslatef(*self._place)
            gl.glRotatef(plan.STATUE_YAW, 0.0, 1.0, 0.0)
            gl.glScalef(*(plan.STATUE_SCALE,) * 3)
            mesh.call()

    def release(self) -> None:
        """Delete the lists and the maps; may be called twice."""
        for each in (*self._lists, self._finest, self._coarser, self._coarsest):
            each.release()
        if self._environment is not None:
            self._environment.release()
