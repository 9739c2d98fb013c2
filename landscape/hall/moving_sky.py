"""The moving sky of Quake: two layers of cloud, one faster than the other (glSkel, Quake's sky).

Technique: a dome around the viewer, with the sky's gradient as vertex colours. The clouds' texture
coordinates are those of a flat ceiling, so that clouds near the horizon are small; the texture
matrix moves them with kt. Two texture units (GL_ARB_multitexture, OpenGL 1.3) lay the layers over
the gradient in one pass: unit 0 the high, slow one, unit 1 the low, fast one, each by its alpha.
Below the horizon lies the sea, a disc in plain colours. Dome and sea have the greatest depth
(glDepthRange) and are drawn after the walls, within the rectangle around the openings in view.
State used: two texture units with their matrices and environments, depth range, scissor, no depth
writes.
What is wrong without its safeguards: with one layer (``sky.layers``) the sky moves like a painted
ceiling. Without ``sky.sorted`` the high clouds are laid over the low ones.
"""

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, combine, matrix
from framelens.gl.texture import Texture
from landscape.elements.element import Element
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.culling import ball_in_view
from landscape.geometry.mesh import grid_triangles
from landscape.gl.display_list import DisplayList
from landscape.gl.features import possible
from landscape.hall import plan
from landscape.hall.exhibits.picture import draw_within, part_of_polygon
from landscape.hall.settings import Settings

RADIUS = 20.0  # chosen: units, within the far plane
RINGS, SIDES = 12, 24  # chosen: of the dome
LOWEST = -0.12  # chosen: radians below the horizon, where the walls hide the dome's edge
FLATNESS = 0.22  # chosen: height of the horizon under the clouds' ceiling, which is 1 high
ZENITH, HORIZON = (0.20, 0.42, 0.78), (0.78, 0.87, 0.95)  # chosen: RGB
# Chosen: the sea's depth below the eye and its radius, units; RGB below the viewer and far away.
SEA = (0.5, 16.0)
DEEP = (0.10, 0.30, 0.38)
HAZE = (0.62, 0.75, 0.84)
# Of the high and the low layer: textures per unit of the ceiling, textures per kt, RGB; chosen.
HIGH = 0.16, (0.00008, 0.00002), (1.0, 0.99, 0.97)
LOW = 0.37, (0.0004, 0.00012), (0.72, 0.76, 0.82)

INSIDE = plan.INSIDE
ROSE = plan.ROSE
HALF = plan.WINDOW_HALF
# The corners (4, 3) of rectangles around the openings: windows, rose window and door.
OPENINGS = [
    *(
        np.array(
            [
                (INSIDE.east, y, z + aside)
                for y, aside in (
                    (plan.WINDOW_SILL, -HALF),
                    (plan.WINDOW_SILL, HALF),
                    (plan.WINDOW_TOP, HALF),
                    (plan.WINDOW_TOP, -HALF),
                )
            ]
        )
        for z in plan.ALCOVES
    ),
    np.array(
        [
            (plan.AXIS + x, ROSE[0] + y, INSIDE.north)
            for x, y in (
                (-ROSE[1], -ROSE[1]),
                (ROSE[1], -ROSE[1]),
                (ROSE[1], ROSE[1]),
                (-ROSE[1], ROSE[1]),
            )
        ]
    ),
    np.array(
        [
            (plan.AXIS + x, y, INSIDE.south)
            for x, y in (
                (-plan.DOOR_HALF, 0.0),
                (plan.DOOR_HALF, 0.0),
                (plan.DOOR_HALF, plan.DOOR_TOP),
                (-plan.DOOR_HALF, plan.DOOR_TOP),
            )
        ]
    ),
]
MIDDLES = [(each.min(axis=0) + each.max(axis=0)) / 2 for each in OPENINGS]
REACH = [float(np.linalg.norm(each[2] - each[0])) / 2 for each in OPENINGS]
Layer = tuple[float, tuple[float, float], tuple[float, float, float]]


def _outwards() -> np.ndarray:
    """Return the directions (n, 3) in which the vertices of the dome are, ring by ring."""
    height = np.linspace(np.pi / 2, LOWEST, RINGS + 1)
    turn = np.arange(SIDES + 1) * 2 * np.pi / SIDES
    up, around = (grid.ravel() for grid in np.meshgrid(height, turn, indexing="ij"))
    level = np.cos(up)
    return np.stack([level * np.cos(around), np.sin(up), level * np.sin(around)], axis=1)


def dome() -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return vertices (n, 3), colours (n, 4) uint8, places on the ceiling (n, 2), triangles (m, 3).

    Triangles are counter-clockwise from below.
    """
    out = _outwards()
    ceiling = out[:, [0, 2]] / (np.maximum(out[:, 1], 0.0) + FLATNESS)[:, None]
    share = np.clip(out[:, 1:2], 0.0, 1.0) ** 0.6
    colors = np.full((len(out), 4), 255, np.uint8)
    colors[:, :3] = 255 * (np.array(HORIZON) * (1 - share) + np.array(ZENITH) * share)
    vertices = np.ascontiguousarray(RADIUS * out, np.float32)
    places = np.ascontiguousarray(ceiling, np.float32)
    return vertices, colors, places, grid_triangles(SIDES + 1, RINGS + 1)


def send_sea() -> None:
    """Send the sea around and below the viewer, bluer the nearer, its far edge in haze."""
    below, radius = SEA
    gl.glBegin(gl.GL_TRIANGLE_FAN)
    gl.glColor3f(*DEEP)
    gl.glVertex3f(0.0, -below, 0.0)
    gl.glColor3f(*HAZE)
    for turn in np.linspace(0.0, 2 * np.pi, SIDES + 1).tolist():
        gl.glVertex3f(radius * np.cos(turn), -below, -radius * np.sin(turn))
    gl.glEnd()


def openings_in_view(frame: Frame, vault: bool = True) -> tuple[int, int, int, int] | None:
    """Return what of the picture holds all openings: x, y, width, height; None if there is none.

    From outside of the hall, and without a ``vault``, the sky is everywhere.
    """
    if not vault:
        return 0, 0, *frame.viewport
    x, y, z = frame.eye.tolist()
    within = INSIDE.west < x < INSIDE.east and INSIDE.north < z < INSIDE.south
    if not (within and 0.0 < y < plan.CROWN):
        return 0, 0, *frame.viewport
    return _around_openings(frame)


def _around_openings(frame: Frame) -> tuple[int, int, int, int] | None:
    """Return what of the picture, seen from within, holds all openings; None if there is none."""
    sign = -1.0 if frame.mirrored else 1.0
    found = []
    for corners, (along, up, across), reach in zip(OPENINGS, MIDDLES, REACH, strict=True):
        if not ball_in_view(frame, (along, sign * up, across), reach):
            continue
        if part := part_of_polygon(frame, corners):
            found.append((part.x, part.y, part.x + part.width, part.y + part.height))

    if not found:
        return None
    left, bottom, right, top = zip(*found, strict=True)
    x0, y0 = min(left), min(bottom)
    return x0, y0, max(right) - x0, max(top) - y0


class MovingSky(Element[Settings]):
    """The sky over the hall."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the clouds and compile the dome."""
        self.settings = settings
        self._clouds = Texture(read_image(assets.path("clouds.png")), trilinear=False)
        vertices, colors, places, triangles = dome()

        def send() -> None:
            with client_arrays(vertices, None, colors, [places] * 2):
                gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

        self._list, self._sea = DisplayList(send), DisplayList(send_sea)

    def draw(self, frame: Frame) -> None:
        """Draw the sky around the viewer, where nothing else is."""
        if (part := openings_in_view(frame, self.settings.room.vault)) is None:
            return
        sky = self.settings.sky
        layers = [HIGH, LOW] if sky.sorted else [LOW, HIGH]
        layers = layers[: sky.layers] if possible("sky.layers") else []
        groups = gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_VIEWPORT_BIT
        with attrib(groups | gl.GL_CURRENT_BIT | gl.GL_SCISSOR_BIT), matrix():
            draw_within(frame, *part)
            gl.glDisable(gl.GL_CLIP_PLANE0)
            gl.glDepthRange(1.0, 1.0)
            gl.glDepthFunc(gl.GL_LEQUAL)
            gl.glDepthMask(gl.GL_FALSE)
            x, y, z = frame.eye.tolist()
            # The mirror matrix puts this at the eye's own height again.
            gl.glTranslatef(x, -y if frame.mirrored else y, z)
            for unit, layer in enumerate(layers):
                self._lay(unit, layer, frame.kt)
            self._list.call()
            for unit in reversed(range(len(layers))):
                self._take_off(unit)
                gl.glDisable(gl.GL_TEXTURE_2D)
            self._sea.call()

        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def _lay(self, unit: int, layer: Layer, kt: float) -> None:
        """Let a texture unit lay a layer over what the units before it made."""
        repeat, (along, across), color = layer
        gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
        gl.glEnable(gl.GL_TEXTURE_2D)
        self._clouds.bind()
        cloud = np.array([*color, 1.0], np.float32)
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, cloud)
        combine(
            {
                "COMBINE_RGB": "INTERPOLATE",
                "SOURCE0_RGB": "CONSTANT",
                "SOURCE1_RGB": "PREVIOUS",
                "SOURCE2_RGB": "TEXTURE",
                "OPERAND2_RGB": "SRC_ALPHA",
            }
        )

        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glPushMatrix()
        gl.glTranslatef(along * kt, across * kt, 0.0)
        gl.glScalef(repeat, repeat, 1.0)
        gl.glMatrixMode(gl.GL_MODELVIEW)

    def _take_off(self, unit: int) -> None:
        gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the list and the texture; may be called twice."""
        self._list.release()
        self._sea.release()
        self._clouds.release()
