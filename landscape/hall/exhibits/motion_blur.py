"""A windmill whose sails turn while the shutter is open (SIGGRAPH 1997, motion blur).

Technique: the sails are drawn at ``exhibits.blur_samples`` times within the shutter's opening, and
the accumulation buffer holds the mean (accumulation.py). A photograph of something fast is such a
mean: where a sail was for half of the time, it covers half. The mill itself does not move and is
drawn once; in the samples it only hides the sails behind it, by its depth.
What is wrong without enough samples: with one the sails stand still in each frame, and seem to turn
backwards when they move by nearly a quarter turn a frame; with four, one sees four of each.
State used: GL_LIGHT2, the accumulation's, the colour mask.
"""

import math

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, matrix
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh, revolve, vertex_normals
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.hall import plan
from landscape.hall.exhibits import niche
from landscape.hall.exhibits.accumulation import Accumulation
from landscape.hall.exhibits.exhibit import Exhibit
from landscape.hall.exhibits.niche import BLUR, MIDDLE, TOP, lit_by
from landscape.hall.settings import Settings

TURN = 11.0  # chosen: degrees that the sails turn in a kt
SAILS = 4  # chosen
LONG, WIDE = 0.062, 0.017  # chosen: length and width of a sail in units
AXLE = TOP + 0.075  # chosen: height of the axle
FRONT = 0.034  # chosen: from the mill's middle to the sails, units
TOWER = ((0.030, 0.0), (0.030, 0.006), (0.026, 0.006), (0.0175, 0.066))  # radius, height
CAP = ((0.0205, 0.066), (0.0205, 0.070), (0.015, 0.084), (0.006, 0.093), (0.0005, 0.097))
PLASTER, ROOF = (0.86, 0.80, 0.68), (0.42, 0.16, 0.10)  # chosen
CLOTHS = ((0.85, 0.16, 0.10), (0.16, 0.30, 0.66))  # chosen: two sails are red and two are blue
WOOD = (0.35, 0.22, 0.12)  # chosen


def flat(corners: np.ndarray) -> Mesh:
    """Return quads (n, 4, 3) as triangles with one normal each, seen from both sides."""
    both = np.concatenate([corners, corners[:, ::-1]])
    vertices = np.ascontiguousarray(both.reshape(-1, 3), np.float32)
    starts = np.arange(len(both), dtype=np.uint32)[:, None] * 4
    triangles = np.concatenate([starts + (0, 1, 2), starts + (0, 2, 3)]).astype(np.uint32)
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles)


def sail(angle_deg: float) -> tuple[Mesh, Mesh]:
    """Return the cloth and the spars of a sail in the plane x = 0, around the origin."""

    def strip(low: float, high: float, left: float, right: float, x: float) -> list[list[float]]:
        return [[x, low, -left], [x, low, -right], [x, high, -right], [x, high, -left]]

    cloth = [strip(0.016, LONG, 0.001, WIDE, 0.0)]
    spars = [strip(0.0, LONG, -0.0015, 0.0015, 0.0006)]
    for y in np.linspace(0.016, LONG, 5).tolist():
        spars.append(strip(y - 0.0006, y + 0.0006, 0.0, WIDE, 0.0006))
    spars.append(strip(0.016, LONG, WIDE - 0.0012, WIDE, 0.0006))
    angle = math.radians(angle_deg)
    c, s = math.cos(angle), math.sin(angle)
    turn = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    found = [flat(np.array(each) @ turn.T) for each in (cloth, spars)]
    return found[0], found[1]


class MotionBlur(Exhibit):
    """The windmill."""

    def __init__(self, settings: Settings, assets: Assets, accumulation: Accumulation | None):
        """Compile mill and sails; without ``accumulation`` they are drawn sharp."""
        self.settings, self._accumulation = settings, accumulation
        self._place = MIDDLE - 0.012, TOP, plan.ALCOVES[BLUR]

        def send_mill() -> None:
            for profile, colour in ((TOWER, PLASTER), (CAP, ROOF)):
                gl.glColor3f(*colour)
                draw_mesh(revolve(profile, 24, (1.0, 1.0)))

        def send_sails() -> None:
            for number in range(SAILS):
                cloth, spars = sail(360.0 / SAILS * number)
                gl.glColor3f(*CLOTHS[number % 2])
                draw_mesh(cloth)
                gl.glColor3f(*WOOD)
                draw_mesh(spars)

        self._mill, self._sails = DisplayList(send_mill), DisplayList(send_sails)

    def draw_plain(self, frame: Frame) -> None:
        """Draw the mill and its sails, sharp."""
        with lit_by(niche.lamp(BLUR)):
            self._send_mill()
            self._send_sails(frame.kt)

    def draw(self, frame: Frame) -> None:
        """Draw the mill, and lay the mean of its sails over it."""
        values, accumulation = self.settings.exhibits, self._accumulation
        count = values.blur_samples
        if accumulation is None or count == 1:
            self.draw_plain(frame)
            return
        lamp = niche.lamp(BLUR)
        with lit_by(lamp):
            self._send_mill()
        times = frame.kt + values.blur_shutter * ((np.arange(count) + 0.5) / count - 0.5)

        def draw(number: int) -> None:
            with attrib(gl.GL_COLOR_BUFFER_BIT):
                gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
                self._send_mill()
            with lit_by(lamp):
                self._send_sails(float(times[number]))

        x, _, z = self._place
        low = x + FRONT - 0.01, AXLE - LONG - 0.004, z - LONG - 0.004
        high = x + FRONT + 0.01, AXLE + LONG + 0.004, z + LONG + 0.004
        if not accumulation.gather_view(frame, low, high, [np.eye(4)] * count, draw):
            with lit_by(lamp):
                self._send_sails(frame.kt)

    def _send_mill(self) -> None:
        with matrix():
            gl.glTranslatef(*self._place)
            self._mill.call()

    def _send_sails(self, kt: float) -> None:
        x, _, z = self._place
        with matrix():
            gl.glTranslatef(x + FRONT, AXLE, z)
            gl.glRotatef(-TURN * kt % 360.0, 1.0, 0.0, 0.0)
            self._sails.call()

    def release(self) -> None:
        """Delete the lists; may be called twice."""
        self._mill.release()
        self._sails.release()
