"""The flight: a camera that flies around the statue along keyframes (glSkel, quaternions).

Technique: each keyframe is a place and an orientation. Places are joined by a closed Catmull-Rom
spline; orientations by SQUAD of unit quaternions (Shoemake's spherical cubic, which the document
calls SCERP), whose angular velocity is continuous at the keys, as that of the places is. To
compare, ``flight.interpolation`` takes SLERP, which turns at constant speed about one axis from key
to key and jerks at each, or the Euler angles yaw, pitch and roll, each on its own.
What is wrong with Euler angles: near the key that looks straight down at the statue, yaw and roll
turn about the same axis. A small turn of the camera is then a large one of both angles, and on the
way between two keys the camera whirls: gimbal lock. A quaternion and its opposite are the same
orientation: without ``flight.short`` SLERP may take the long way around. ``flight.path`` draws the
camera's path as a ribbon as wide as the camera's right axis, red above and blue below, and the
camera at some places on it: right in red, up in green, back in blue.
State used: for the path GL_TRIANGLE_STRIP and GL_LINES with colour arrays, culling and the line
width; no texture, no lighting.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, line_width
from landscape.elements.element import Element
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose
from landscape.geometry.quaternion import from_angles, looking, slerp, squad, to_angles, turned
from landscape.geometry.splines import SPLINES
from landscape.hall import plan
from landscape.hall.settings import Flight as FlightSettings
from landscape.hall.settings import Settings

# Chosen: eye, what it looks at, and what is up in its picture, in the order of the flight. The
# camera flies over the statue's back with its nose down, is upside down behind it, and rolls out.
STATUE = (plan.AXIS, 0.22, plan.STATUE[1])
VIEWPOINTS = (
    ((1.60, 0.13, 1.80), STATUE, (0.0, 1.0, 0.0)),
    ((1.72, 0.34, 1.66), STATUE, (0.1, 1.0, 0.0)),
    ((1.63, 0.60, 1.38), STATUE, (0.0, 1.0, -0.4)),
    ((1.58, 0.60, 1.02), STATUE, (0.0, -0.4, -1.0)),
    ((1.45, 0.42, 0.82), STATUE, (-1.0, -0.1, -0.4)),
    ((1.42, 0.22, 0.70), STATUE, (-0.4, 1.0, 0.0)),
    ((1.76, 0.12, 0.66), STATUE, (0.2, 1.0, 0.0)),
    ((1.84, 0.10, 1.10), (1.6, 0.28, 1.24), (0.0, 1.0, 0.0)),
)
AXIS_LENGTH = 0.06  # chosen: units
COLORS = np.array([(230, 60, 40), (70, 200, 80), (80, 130, 255)], np.uint8)  # right, up, back
STEPS = 2  # chosen: cameras drawn from key to key
PIECES = 32  # chosen: pieces of the ribbon from key to key
HALF = 0.036  # chosen: half the ribbon's width, in units
SIDES = np.array([(250, 150, 60), (60, 110, 210)])  # chosen: RGB of its upper and its lower side


class Key(NamedTuple):
    """A keyframe: the eye's place (3,), its orientation as a quaternion (4,) and in degrees (3,).

    The degrees are yaw, pitch and roll.
    """

    place: np.ndarray
    turn: np.ndarray
    angles: np.ndarray


def keyframes() -> list[Key]:
    """Return the keys of the flight.

    Of each orientation's two quaternions one is taken at random, as a file of keys may have either.
    """
    signs = np.random.default_rng(1997).choice([-1.0, 1.0], len(VIEWPOINTS))
    keys = []
    for sign, (eye, target, up) in zip(signs, VIEWPOINTS, strict=True):
        turn = looking(*(np.array(each, np.float64) for each in (eye, target, up)))
        keys.append(Key(np.array(eye), sign * turn, np.array(to_angles(turn))))
    return keys


def orientation(flight: FlightSettings, four: Sequence[Key], t: float) -> np.ndarray:
    """Return the camera's orientation (4,) between the middle two of four keys, at t in 0..1."""
    here, there = four[1:3]
    if flight.interpolation == "squad":
        return squad([key.turn for key in four], t)
    if flight.interpolation == "slerp":
        return slerp(here.turn, there.turn, t, flight.short)
    # Each angle takes its short way: from 350 to 10 degrees is 20 degrees.
    change = (there.angles - here.angles + 180.0) % 360.0 - 180.0
    return from_angles(*(here.angles + t * change))


class Flight(Element[Settings]):
    """The camera's path around the statue."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Place the keys."""
        self.settings, self._keys = settings, keyframes()

    def camera(self, kt: float) -> tuple[np.ndarray, np.ndarray]:
        """Return the eye's place (3,) and the camera's orientation (4,) at a time."""
        flight, keys = self.settings.flight, self._keys
        number, t = divmod(kt / flight.kt_per_key, 1.0)
        four = [keys[(int(number) + k) % len(keys)] for k in (-1, 0, 1, 2)]
        weights = np.array([t**3, t**2, t, 1.0]) @ SPLINES["catmull_rom"]
        place = weights @ np.stack([key.place for key in four])
        return place, orientation(flight, four, t)

    def pose(self, kt: float) -> Pose:
        """Return where the camera is at a time."""
        (x, y, z), turn = self.camera(kt)
        return Pose(float(x), float(y), float(z), *to_angles(turn))

    def draw(self, frame: Frame) -> None:
        """Draw the path as a ribbon, and the camera's axes at STEPS places from key to key."""
        with attrib(gl.GL_LINE_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT | gl.GL_ENABLE_BIT):
            self._draw_ribbon()
            self._draw_axes(frame.size[1] / 200)

    def _along(self, pieces: int) -> tuple[np.ndarray, np.ndarray]:
        """Return the eye's places (n, 3) and the camera's axes (n, 3, 3), ``pieces`` a key."""
        span = self.settings.flight.kt_per_key
        cameras = [self.camera(k * span / pieces) for k in range(pieces * len(self._keys))]
        places = np.stack([place for place, _ in cameras])
        return places, np.stack([turned(turn, np.eye(3)) for _, turn in cameras])

    def _draw_ribbon(self) -> None:
        """Draw a strip between the ends of the camera's right axis, its two sides in two colours.

        Each side is the darker the steeper it stands, as there is no light.
        """
        places, axes = self._along(PIECES)
        right, up = HALF * axes[:, 0], axes[:, 1]
        edges = np.stack([places - right, places + right], axis=1)
        points = np.concatenate([edges, edges[:1]]).reshape(-1, 3).astype(np.float32)
        shade = 0.45 + 0.55 * np.abs(up[:, 1])
        shade = np.repeat(np.append(shade, shade[0]), 2)[:, None]
        gl.glEnable(gl.GL_CULL_FACE)
        for color, hidden in zip(SIDES, (gl.GL_BACK, gl.GL_FRONT), strict=True):
            gl.glCullFace(hidden)
            with client_arrays(points, colors=np.rint(shade * color).astype(np.uint8)):
                gl.glDrawArrays(gl.GL_TRIANGLE_STRIP, 0, len(points))
        gl.glDisable(gl.GL_CULL_FACE)

    def _draw_axes(self, width: float) -> None:
        """Draw the camera as three lines, at some places."""
        places, axes = self._along(STEPS)
        tips = places[:, None] + AXIS_LENGTH * axes
        lines = np.stack([np.broadcast_to(places[:, None], tips.shape), tips], axis=2)
        points = lines.reshape(-1, 3).astype(np.float32)
        colors = np.ascontiguousarray(np.tile(np.repeat(COLORS, 2, axis=0), (len(places), 1)))
        line_width(width)
        with client_arrays(points, colors=colors):
            gl.glDrawArrays(gl.GL_LINES, 0, len(points))
