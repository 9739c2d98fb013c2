"""The pool's water: a thin surface over the bed, which it tints, and which mirrors the hall.

Technique: one grid, blended twice. First the water's own colour: light that comes up from the bed
has passed through the more water the flatter it leaves, and each colour is dimmed by its own
exponential of that way (Beer-Lambert), so the grid multiplies what is there (GL_ZERO,
GL_SRC_COLOR). Then what the surface mirrors, the more the flatter it is looked at (Schlick 1994),
with GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA: a cube map (OpenGL 1.3) of the hall, drawn once from the
pool's middle. Waves tilt the normal at each vertex of the grid. GL_REFLECTION_MAP would look the
mirrored line of sight up as if everything were infinitely far away; here it is followed to the
walls, as to those of a box, and the direction from the pool's middle to where it arrives is sent
as coordinates. So the windows' images stay below the windows, wherever one stands.
What is wrong with it: what stands between the pool and the walls, the statue and the pillars, is
mirrored a little too far away. With ``pool.absorbs`` off the water has no depth, with
``pool.mirrors`` 0 no surface; without cube maps it mirrors one colour.
State used: GL_BLEND, GL_TEXTURE_CUBE_MAP.
"""

from collections.abc import Callable

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays
from landscape.elements.element import Element
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles
from landscape.gl.cube_map import CubeMap
from landscape.gl.features import possible
from landscape.hall import plan
from landscape.hall.environment import cube_around
from landscape.hall.settings import Settings

CELLS = 24, 36  # chosen: of the grid, along x and z
INDEX = 1.333  # of refraction, of water
FACING = ((INDEX - 1) / (INDEX + 1)) ** 2  # reflected where it is looked at from straight above
MIRRORED = (0.62, 0.68, 0.70)  # chosen: RGB of what is mirrored without a cube map
SIDE = 256  # chosen: of a face of the cube map, in texels
ABOVE = ("POSITIVE_X", "NEGATIVE_X", "POSITIVE_Y", "POSITIVE_Z", "NEGATIVE_Z")  # the water sees
CENTRE = plan.AXIS, 0.03, (plan.POOL.north + plan.POOL.south) / 2  # chosen: where it is drawn from
CEILING = 0.66  # chosen: height of the box that stands for the hall, between springing and crown
LEAST = 0.02  # chosen: sine of the elevation of a mirrored line; steep waves would mirror the bed
# Chosen: the waves' numbers along x and z in radians per unit, radians per kt, and steepness.
WAVES = (
    (38.0, 61.0, 0.071, 0.011),
    (-71.0, 33.0, 0.083, 0.008),
    (12.0, -97.0, 0.102, 0.007),
    (88.0, 74.0, 0.118, 0.006),
    (-24.0, -31.0, 0.049, 0.010),
)


def surface() -> tuple[np.ndarray, np.ndarray]:
    """Return the grid's vertices, float32 (n, 3), and its triangles, uint32 (m, 3)."""
    pool, (across, along) = plan.POOL, CELLS
    x, z = np.meshgrid(
        np.linspace(pool.west, pool.east, across + 1),
        np.linspace(pool.north, pool.south, along + 1),
    )
    points = np.stack([x, np.full_like(x, plan.POOL_WATER), z], axis=-1)
    return points.reshape(-1, 3).astype(np.float32), grid_triangles(across + 1, along + 1)


def steepness(vertices: np.ndarray, eye: np.ndarray) -> np.ndarray:
    """Return the sine of the elevation of an eye (3,) above level places (n, 3), 0..1."""
    away = eye - vertices
    return np.asarray(np.clip(away[:, 1] / np.linalg.norm(away, axis=1), 0.0, 1.0))


def left_of_light(steep: np.ndarray, depth: float, clear: tuple[float, ...]) -> np.ndarray:
    """Return what the water leaves of the bed's colours, (n, 3), seen at ``steep`` (n,).

    ``clear`` holds, for red, green and blue, the way in units on which a third of the light is
    left. Light goes down to the bed and comes up again; Snell's law makes the way up steeper.
    """
    refracted = np.sqrt(1.0 - (1.0 - steep**2) / INDEX**2)
    way = depth * (1.0 + 1.0 / refracted)
    return np.asarray(np.exp(-way[:, None] / np.array(clear)))


def mirrored_share(steep: np.ndarray) -> np.ndarray:
    """Return the share of light that is reflected, (n,) 0..1, looked at at ``steep`` (n,)."""
    return np.asarray(FACING + (1.0 - FACING) * (1.0 - steep) ** 5)


def waves(vertices: np.ndarray, kt: float) -> np.ndarray:
    """Return the surface's unit normals (n, 3) at level places (n, 3)."""
    x, z = vertices[:, 0].astype(np.float64), vertices[:, 2].astype(np.float64)
    normals = np.zeros((len(vertices), 3))
    normals[:, 1] = 1.0
    for along_x, along_z, turn, steep in WAVES:
        slope = steep * np.cos(along_x * x + along_z * z + turn * kt)
        length = np.hypot(along_x, along_z)
        normals[:, 0] -= slope * along_x / length
        normals[:, 2] -= slope * along_z / length
    return np.asarray(normals / np.linalg.norm(normals, axis=1, keepdims=True))


def mirrored(
    vertices: np.ndarray, normals: np.ndarray, eye: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return where what is mirrored lies from CENTRE (n, 3), and the share of light (n,).

    ``eye`` (3,) looks at places (n, 3) with unit normals (n, 3). Walls and ceiling are a box.
    """
    sight = vertices - eye
    sight = sight / np.linalg.norm(sight, axis=1, keepdims=True)
    met = np.clip(-(sight * normals).sum(axis=1), 0.0, 1.0)
    ray = sight + 2.0 * met[:, None] * normals
    ray[:, 1] = np.maximum(ray[:, 1], LEAST)
    inside = plan.INSIDE
    low = np.array([inside.west, -1.0, inside.north])
    high = np.array([inside.east, CEILING, inside.south])
    ray = np.where(np.abs(ray) < 1e-6, 1e-6, ray)
    reach = (np.where(ray > 0.0, high, low) - vertices) / ray
    return vertices + reach.min(axis=1, keepdims=True) * ray - CENTRE, mirrored_share(met)


class Pool(Element[Settings]):
    """The water in the pool."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Build the grid."""
        self.settings = settings
        self._vertices, self._triangles = surface()
        self._cube: CubeMap | None = None

    def reflect(self, draw: Callable[[Frame], None]) -> None:
        """Let the water mirror what ``draw`` draws around it, where this OpenGL can."""
        if possible("pool.mirrors"):
            self._cube = cube_around(CENTRE, SIDE, draw, ABOVE)

    def draw(self, frame: Frame) -> None:
        """Blend the surface over the bed."""
        values = self.settings.pool
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT
        with attrib(groups | gl.GL_DEPTH_BUFFER_BIT | gl.GL_TEXTURE_BIT):
            gl.glEnable(gl.GL_BLEND)
            gl.glDepthMask(gl.GL_FALSE)
            if values.absorbs:
                gl.glBlendFunc(gl.GL_ZERO, gl.GL_SRC_COLOR)
                depth = plan.POOL_WATER - plan.POOL_BED
                steep = steepness(self._vertices, frame.eye)
                self._send(left_of_light(steep, depth, values.clear))
            if values.mirrors:
                gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
                self._draw_mirrored(frame, values.mirrors)

    def _draw_mirrored(self, frame: Frame, strength: float) -> None:
        """Blend what the surface mirrors over what is seen through it."""
        normals = waves(self._vertices, frame.kt)
        places, share = mirrored(self._vertices, normals, frame.eye)
        colours = np.ones((len(share), 4))
        colours[:, 3] = np.minimum(share * strength, 1.0)
        if self._cube is None:
            colours[:, :3] = MIRRORED
            self._send(colours)
            return
        gl.glEnable(gl.GL_TEXTURE_CUBE_MAP)
        self._cube.bind()
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        self._send(colours, np.ascontiguousarray(places, np.float32))

    def _send(self, colours: np.ndarray, *coordinates: np.ndarray) -> None:
        """Send the grid with colours (n, 3 or 4), and with coordinates for unit 0 or none."""
        sent = np.ascontiguousarray(colours, np.float32)
        with client_arrays(self._vertices, None, sent, coordinates):
            count = self._triangles.size
            gl.glDrawElements(gl.GL_TRIANGLES, count, gl.GL_UNSIGNED_INT, self._triangles)

    def release(self) -> None:
        """Delete the cube map; may be called twice."""
        if self._cube is not None:
            self._cube.release()
