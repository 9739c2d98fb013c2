"""The pool's water: a thin surface over the bed, which it tints and mirrors a little.

Technique: one grid, blended twice. First the water's own colour: light that comes up from the bed
has passed through the more water the flatter it leaves, and each colour is dimmed by its own
exponential of that way (Beer-Lambert), so the grid multiplies what is there (GL_ZERO,
GL_SRC_COLOR). Then what the surface mirrors, the more the flatter it is looked at (Schlick 1994),
with GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA. A texture of ripples moves over it in two directions, and
breaks the mirrored light up.
What is wrong without it: with ``pool.absorbs`` off the water has no depth, with ``pool.mirrors``
off no surface.
State used: GL_BLEND, GL_TEXTURE_2D in two units with GL_COMBINE (OpenGL 1.3), texture matrices.
"""

import numpy as np

from landscape.effects import plan
from landscape.effects.settings import Settings
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles
from landscape.gl.calls import gl
from landscape.gl.state import attrib, client_arrays, combine
from landscape.gl.texture import Texture

CELLS = 12, 18  # chosen: of the grid, along x and z
INDEX = 1.333  # of refraction, of water
FACING = ((INDEX - 1) / (INDEX + 1)) ** 2  # reflected where it is looked at from straight above
MIRRORED = (0.62, 0.68, 0.70)  # chosen: RGB of what is mirrored, mostly the windows' sky
REPEAT = 3.2  # chosen: textures of ripples per unit
DRIFTS = ((0.0021, 0.0013), (-0.0017, 0.0024))  # chosen: textures per kt, of the two


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


class Pool:
    """The water in the pool."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the texture of ripples."""
        self._settings = settings
        self._vertices, self._triangles = surface()
        self._coordinates = np.ascontiguousarray(self._vertices[:, [0, 2]] * np.float32(REPEAT))
        self._ripples = Texture(read_image(assets.path("water.png"), "RGB"))

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; all are read at each draw."""
        self._settings = settings
        return True

    def draw(self, frame: Frame) -> None:
        """Blend the surface over the bed."""
        values = self._settings.pool
        steep = steepness(self._vertices, frame.eye)
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT
        with attrib(groups | gl.GL_DEPTH_BUFFER_BIT | gl.GL_TEXTURE_BIT):
            gl.glEnable(gl.GL_BLEND)
            gl.glDepthMask(gl.GL_FALSE)
            if values.absorbs:
                gl.glBlendFunc(gl.GL_ZERO, gl.GL_SRC_COLOR)
                depth = plan.POOL_WATER - plan.POOL_BED
                self._send(left_of_light(steep, depth, values.clear))
            if values.mirrors:
                gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
                colours = np.empty((len(steep), 4))
                colours[:] = (*MIRRORED, 1.0)
                colours[:, 3] = np.minimum(mirrored_share(steep) * values.mirrors, 1.0)
                self._draw_ripples(frame.kt, colours)

    def _draw_ripples(self, kt: float, colours: np.ndarray) -> None:
        """Draw the mirrored light, times two layers of ripples that drift across each other."""
        for unit, (s, t) in enumerate(DRIFTS):
            gl.glActiveTexture(getattr(gl, f"GL_TEXTURE{unit}"))
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._ripples.bind()
            combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"})
            combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
            gl.glMatrixMode(gl.GL_TEXTURE)
            gl.glPushMatrix()
            gl.glTranslatef(s * kt % 1.0, t * kt % 1.0, 0.0)
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)
        self._send(colours, 2)
        for unit in (1, 0):
            gl.glActiveTexture(getattr(gl, f"GL_TEXTURE{unit}"))
            gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_MODELVIEW)

    def _send(self, colours: np.ndarray, units: int = 0) -> None:
        """Send the grid with colours (n, 3 or 4), and with coordinates for some units."""
        sent = np.ascontiguousarray(colours, np.float32)
        with client_arrays(self._vertices, None, sent, [self._coordinates] * units):
            count = self._triangles.size
            gl.glDrawElements(gl.GL_TRIANGLES, count, gl.GL_UNSIGNED_INT, self._triangles)

    def release(self) -> None:
        """Delete the texture; may be called twice."""
        self._ripples.release()
