"""The statue: the sea dragon, in bronze, on its plinth.

Technique: a lit mesh in a display list, or from afar a simpler one (vertex clustering). It is also
the mask for a change of tone. It is gilded: environment.py draws what it mirrors. Its mirror image
is a coarser mesh of side 2, which glScalef brings to its size: that scales the normals, too, and
GL_NORMALIZE makes them unit vectors again. Its shadows are those of meshes coarser still.
State used: lighting, the material, culling, GL_NORMALIZE.
"""

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from landscape.effects import plan
from landscape.effects.environment import NEEDS, Environment
from landscape.effects.settings import Settings
from landscape.elements.animal import read_animal
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.clustering import clustered
from landscape.geometry.culling import ball_in_view
from landscape.geometry.mesh import gathered, scaled
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.extensions import first_missing, tell_off
from landscape.gl.state import attrib, front_faces, matrix

YAW = -165.0  # degrees, chosen: in profile from the door, so that its shadow shows the open jaws
BRONZE = (0.72, 0.50, 0.22)  # chosen
GLOW = 0.5  # chosen: fraction of the gold's colour that mirrors in the dark
GLINT, SHININESS = (0.5, 0.42, 0.26, 1.0), 60.0  # chosen
# Chosen: sides of the cubes whose vertices are merged, of a mesh of 2: for its image, and for its
# shadows, from afar and from nearby.
COARSE, COARSEST, COARSER = 0.025, 0.045, 0.03
FROM_AFAR = 0.0125, 0.02  # chosen: the same for the statue itself from afar
PIXELS = 2.0  # chosen: how many pixels such a cube may be wide


class Statue:
    """The statue."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the mesh and compile its display list."""
        self._settings = settings
        unit = read_animal(assets, "dragon.ply", "dragon.mesh")
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
        simpler = [scaled(gathered(clustered(unit, c)), plan.STATUE_SCALE) for c in FROM_AFAR]
        self._levels = [DisplayList(partial(draw_mesh, each)) for each in (mesh, *simpler)]
        self._list = self._levels[0]
        self._coarse = DisplayList(lambda: draw_mesh(coarse))
        self._coarser = DisplayList(lambda: draw_mesh(coarser))
        self._coarsest = DisplayList(lambda: draw_mesh(coarsest))

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; nothing built depends on them."""
        self._settings = settings
        if self._environment is not None:
            self._environment.apply(settings)
        return True

    def gild(self, draw: Callable[[Frame], None]) -> None:
        """Let the statue mirror what ``draw`` draws around it, where this OpenGL can."""
        if need := first_missing(NEEDS):
            tell_off("statue.environment", need)
        else:
            self._environment = Environment(self._settings, self.middle, draw)

    def draw(self, frame: Frame) -> None:
        """Draw the statue, lit."""
        if not self._in_view(frame):
            return
        if not frame.mirrored:
            self._list = self._level_for(frame)
        if self._environment is not None:
            self._environment.prepare(frame)
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT
        gilded = self._environment is not None and self._settings.statue.environment != "none"
        with attrib(groups), front_faces():
            gl.glEnable(gl.GL_LIGHTING)
            gl.glEnable(gl.GL_COLOR_MATERIAL)
            gl.glColor3f(*(self._settings.statue.gold if gilded else BRONZE))
            if frame.mirrored and self._settings.mirror.normals:
                gl.glEnable(gl.GL_NORMALIZE)
            send = self.send_coarse if frame.mirrored else self.send
            if gilded and self._environment is not None:
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
        return self._levels[sum(each <= cell for each in FROM_AFAR)]

    def _polish(self) -> None:
        """Set a metal's material: what it mirrors shows without direct light, too, and it glints.

        The glint is added after the texture, by GL_SEPARATE_SPECULAR_COLOR (OpenGL 1.2).
        """
        glow = np.array([GLOW * each for each in self._settings.statue.gold] + [1.0], np.float32)
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_EMISSION, glow)
        gl.glLightModeli(gl.GL_LIGHT_MODEL_COLOR_CONTROL, gl.GL_SEPARATE_SPECULAR_COLOR)
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_SPECULAR, np.array(GLINT, np.float32))
        gl.glMaterialf(gl.GL_FRONT, gl.GL_SHININESS, SHININESS)

    def send(self) -> None:
        """Send the mesh that was drawn last at its place, whatever the state."""
        with matrix():
            gl.glTranslatef(*self._place)
            gl.glRotatef(YAW, 0.0, 1.0, 0.0)
            self._list.call()

    def send_coarse(self) -> None:
        """Send a coarser mesh at its place, its normals longer than 1."""
        self._send_scaled(self._coarse)

    def send_shadowing(self, frame: Frame) -> None:
        """Send the mesh that casts the shadows at its place."""
        near = frame.pose.z < plan.STATUE[1]  # on the side of the wall that it falls on
        self._send_scaled(self._coarser if near else self._coarsest)

    def _send_scaled(self, mesh: DisplayList) -> None:
        with matrix():
            gl.glTranslatef(*self._place)
            gl.glRotatef(YAW, 0.0, 1.0, 0.0)
            gl.glScalef(*(plan.STATUE_SCALE,) * 3)
            mesh.call()

    def release(self) -> None:
        """Delete the lists and the maps; may be called twice."""
        for each in (*self._levels, self._coarse, self._coarser, self._coarsest):
            each.release()
        if self._environment is not None:
            self._environment.release()
