"""The water: a plane that mixes what it mirrors and what lies under it by Fresnel's term.

Technique, in one pass with four texture units (the document did it in a shader):
- unit 0, a map of ripples' normals times the half vector between sun and eye in the vertex colour,
  by GL_DOT3_RGBA: how nearly each ripple mirrors the sun, in alpha;
- unit 1, the picture of what lies under the water, laid on as a slide projector would: the texture
  matrix is the camera's projection. The same for unit 2, the picture of what is mirrored;
- unit 3, the alpha cube map of Fresnel's term, addressed by vertex minus eye. Unit 2 mixes the two
  pictures by it (GL_INTERPOLATE; GL_ARB_texture_env_crossbar lets it read unit 3's texture);
- units 1 and 2 leave of alpha only the glints, and unit 3 mixes in the sun's colour by them.
Both pictures are disturbed by moving their coordinates at the vertices of a grid.
With fewer units, or an older OpenGL, there are no glints, and then Fresnel's term is a constant.
With a single unit, or without framebuffer objects, the water is a plain blended plane.
State used: texture units 0 to 3, GL_COMBINE, the texture matrices; or GL_BLEND.
"""

from collections.abc import Hashable, Iterator
from contextlib import contextmanager

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, combine
from framelens.gl.texture import Texture
from landscape.elements import sun
from landscape.elements.element import Element
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.gl.cube_map import CubeMap
from landscape.gl.display_list import DisplayList
from landscape.gl.features import possible
from landscape.gl.surface_query import SurfaceQuery
from landscape.voxel.fresnel import fresnel_faces
from landscape.voxel.settings import Settings
from landscape.voxel.tiles import ripples
from landscape.voxel.water_grid import (
    calmed,
    disturbed,
    grid_quads,
    half_vectors,
    refracted,
    water_grid,
)
from landscape.voxel.water_images import WaterImages
from landscape.voxel.world import BELOW

BIAS = np.array([[0.5, 0, 0, 0.5], [0, 0.5, 0, 0.5], [0, 0, 0.5, 0.5], [0, 0, 0, 1]])
RIPPLE_SIZE = 1.3  # units, chosen: the side of the map of normals on the water
EVEN = 0.4  # chosen: how much is mirrored at all angles, where Fresnel's term is not known
PLAIN = 0.8  # chosen: alpha of water that is a plain colour
STEEPER = 1.8  # times, chosen: the ripples' slopes; gentle ones would all glint at once
NARROW = 0.02  # chosen: how far below 1 the cosine may be for a ripple to glint
SHARES = (0.4, 0.5, 0.6)  # chosen: of long, middling and short waves in the ripples
SHARPER = -1.0  # mip levels, chosen: farther away ripples would be too level to glint
DRIFT = 0.0011  # chosen: units per kt by which it moves


class Water(Element[Settings]):
    """The water of the whole map, and beyond it to the horizon."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return what the constructor uses of the settings."""
        return settings.water.fresnel, settings.water.by_angle

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Make the textures; ``images`` is None where the water can only be a plain colour."""
        self.settings = settings
        self._quads = grid_quads()
        self.images: WaterImages | None = None
        self.query: SurfaceQuery | None = None
        self._fresnel: CubeMap | None = None
        self._normals: Texture | None = None
        self._state: DisplayList | None = (
            None  # the textures and equations, and what they depend on
        )
        self._made_of: tuple[float, ...] = ()

        if not possible("water.reflection, water.refraction"):
            return

        self.images = WaterImages(settings.water)
        far = settings.camera.far
        side = settings.voxel.regions * settings.voxel.region_size * settings.voxel.block
        if possible("water.query"):  # without it the pictures are drawn in any case
            self.query = SurfaceQuery(self.level, -far, side + far, settings.camera.near)
        if possible("water.fresnel"):
            faces = fresnel_faces(settings.water.fresnel, settings.water.by_angle)
            self._fresnel = CubeMap(faces, mipmaps=False)
        if possible("water.sparkle"):
            normals = steepened(finer(ripples(assets)), STEEPER)
            self._normals = Texture(normals, lod_bias=SHARPER)

    @property
    def level(self) -> float:
        """The height of the water in units."""
        values = self.settings.voxel
        return (values.sea - BELOW) * values.block

    def grid(self, frame: Frame) -> np.ndarray | None:
        """Return the points of the water in view (n, 3), None if there are none."""
        return water_grid(frame, self.level, self.settings.camera.far * 0.9)

    def draw(  # type: ignore[override]  # where the scene has found it in view
        self,
        frame: Frame,
        clip: np.ndarray,
        points: np.ndarray,
        depth: np.ndarray,
        haze: tuple[float, ...] = (),
    ) -> None:
        """Draw the water at ``points`` (n, 3), which is ``depth`` (n,) units deep there.

        ``clip`` is the camera's projection times modelview, ``haze`` the colour into which it fades
        far away: that of the sea at the horizon, unless it is another.
        """
        values = self.settings.water
        if self.images is None:
            self._draw_plain(points)
            return
        ways = points - frame.eye.astype(np.float32)
        away = np.sqrt(np.einsum("ij,ij->i", ways, ways))
        moved = disturbed(points, away, depth, frame.kt, values.ripples)
        half = half_vectors(ways, away, sun.direction(self.settings.sun))
        half = calmed(half, away, depth)
        if frame.eye_y < self.level:
            half[:] = 0.0  # glints are seen from above
        coordinates = [moved, moved]
        if values.bending == "walter" and frame.eye_y > self.level:
            coordinates[0] = refracted(points, ways, away, depth, frame.kt, values.ripples)
        if self._normals:
            drift = np.array([0.8, 0.6]) * DRIFT * frame.kt % 1.0
            coordinates.insert(0, points[:, ::2] / RIPPLE_SIZE + drift.astype(np.float32))
        if self._fresnel:
            coordinates.append(ways)
        groups = gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT | gl.GL_CURRENT_BIT | gl.GL_FOG_BIT
        with attrib(groups), self._projected(clip), arrays(points, half, coordinates):
            self._combined()
            gl.glFogfv(gl.GL_FOG_COLOR, np.array([*(haze or values.horizon), 1.0], np.float32))
            gl.glDrawElements(gl.GL_QUADS, self._quads.size, gl.GL_UNSIGNED_INT, self._quads)

        gl.glActiveTexture(gl.GL_TEXTURE0)

    def _draw_plain(self, points: np.ndarray) -> None:
        """Draw the water as a blended colour."""
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT
        with (
            attrib(groups | gl.GL_FOG_BIT),
            client_arrays(points),
        ):
            gl.glEnable(gl.GL_BLEND)
            gl.glFogfv(gl.GL_FOG_COLOR, np.array([*self.settings.water.horizon, 1.0], np.float32))
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glColor4f(*self.settings.water.color, PLAIN)
            gl.glDrawElements(gl.GL_QUADS, self._quads.size, gl.GL_UNSIGNED_INT, self._quads)

    def _unit(self, k: int) -> int:
        """Return unit ``k`` of the equations above; without glints they are one less."""
        return int(gl.GL_TEXTURE0) + k - (self._normals is None)

    @contextmanager
    def _projected(self, clip: np.ndarray) -> Iterator[None]:
        """Let units 1 and 2 look up, at a point, the pixel of the screen where it is seen."""
        whole = np.ascontiguousarray((BIAS @ clip).T, np.float32)
        gl.glMatrixMode(gl.GL_TEXTURE)
        for k in (1, 2):
            gl.glActiveTexture(self._unit(k))
            gl.glPushMatrix()
            gl.glLoadMatrixf(whole)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        try:
            yield
        finally:
            gl.glMatrixMode(gl.GL_TEXTURE)
            for k in (1, 2):
                gl.glActiveTexture(self._unit(k))
                gl.glPopMatrix()
            gl.glMatrixMode(gl.GL_MODELVIEW)

    def _combined(self) -> None:
        """Bind the textures and set the units' equations, which are compiled once."""
        images, values = self.images, self.settings.water
        assert images and images.reflection and images.refraction
        made_of: tuple[float, ...] = images.reflection.name, images.refraction.name
        made_of += values.fresnel, values.sparkle, *glint_colour(self.settings.sun.diffuse)
        if self._state is None or self._made_of != made_of:
            self._forget_state()
            self._state, self._made_of = DisplayList(self._combine), made_of
        self._state.call()

    def _forget_state(self) -> None:
        if self._state is not None:
            self._state.release()
            self._state = None

    def _combine(self) -> None:
        """Bind the textures and set the units' equations."""
        images = self.images
        assert images and images.reflection and images.refraction
        glint = float(self.settings.water.sparkle)
        if self._normals:
            gl.glActiveTexture(self._unit(0))
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._normals.bind()
            combine({"COMBINE_RGB": "DOT3_RGBA", "SRC0_RGB": "TEXTURE"})
            combine({"SRC1_RGB": "PRIMARY_COLOR"})

        gl.glActiveTexture(self._unit(1))
        gl.glEnable(gl.GL_TEXTURE_2D)
        images.refraction.bind()

        # What remains of the alpha above a threshold, four times as much; unit 2 makes it 32 times.
        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "TEXTURE"})
        combine({"COMBINE_ALPHA": "SUBTRACT", "SRC0_ALPHA": "PREVIOUS", "SRC1_ALPHA": "CONSTANT"})
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_ALPHA_SCALE, 4.0)
        threshold = np.array([0.0, 0.0, 0.0, 1.0 - NARROW * glint], np.float32)
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, threshold)
        gl.glActiveTexture(self._unit(2))
        gl.glEnable(gl.GL_TEXTURE_2D)
        images.reflection.bind()
        combine({"COMBINE_RGB": "INTERPOLATE", "SRC0_RGB": "TEXTURE", "SRC1_RGB": "PREVIOUS"})
        last = self._unit(3)
        by = f"TEXTURE{last - int(gl.GL_TEXTURE0)}" if self._fresnel else "CONSTANT"
        combine({"SRC2_RGB": by, "OPERAND2_RGB": "SRC_ALPHA"})
        even = min(EVEN * self.settings.water.fresnel, 1.0)
        constant = np.array([0.0, 0.0, 0.0, even], np.float32)
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, constant)
        combine({"COMBINE_ALPHA": "ADD", "SRC0_ALPHA": "PREVIOUS", "SRC1_ALPHA": "PREVIOUS"})
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_ALPHA_SCALE, 4.0)
        if not (self._fresnel or self._normals):
            return
        gl.glActiveTexture(last)
        if self._fresnel:
            gl.glEnable(gl.GL_TEXTURE_CUBE_MAP)
            self._fresnel.bind()
        elif self._normals:  # a unit without a texture would be left out
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._normals.bind()

        combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PREVIOUS"})
        combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
        if self._normals:
            combine({"COMBINE_RGB": "INTERPOLATE", "SRC0_RGB": "CONSTANT", "SRC1_RGB": "PREVIOUS"})
            combine({"SRC2_RGB": "PREVIOUS", "OPERAND2_RGB": "SRC_ALPHA"})
            colour = np.array([*glint_colour(self.settings.sun.diffuse), 1.0], np.float32)
            gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, colour)

    def take(self, settings: Settings) -> None:
        """Take other settings, for the pictures as well."""
        self.settings = settings
        if self.images:
            self.images.values = settings.water

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        self._forget_state()
        for owned in (self.images, self.query, self._normals, self._fresnel):
            if owned is not None:
                owned.release()


def glint_colour(sunlight: tuple[float, ...]) -> tuple[float, ...]:
    """Return the colour of glints in the light of a sun: its own, as bright as can be."""
    brightest = max(*sunlight, 1e-3)
    return tuple(part / brightest for part in sunlight)


def finer(normals: np.ndarray) -> np.ndarray:
    """Return a map of normals, uint8 (2 n, 2 n, 3), with shorter waves, too, than one (n, n, 3).

    It is the map at twice its size, and across that the same map once and at a third of its size.
    So glints are small points near the eye, and the pattern does not repeat sooner.
    """
    decoded = normals / 127.5 - 1.0
    slope = decoded[..., :2] / decoded[..., 2:]
    at = np.arange(2 * len(slope))
    rows = (slope[at // 2] + slope[(at + 1) // 2 % len(slope)]) / 2
    wide = (rows[:, at // 2] + rows[:, (at + 1) // 2 % len(slope)]) / 2
    across = np.moveaxis(slope, 0, 1)[..., ::-1]
    own, small = (
        across[np.ix_(times * at % len(slope), times * at % len(slope))] for times in (1, 3)
    )
    total = np.tensordot(SHARES, np.stack([wide, own, small]), 1)
    found = np.concatenate([total, np.ones((*total.shape[:2], 1))], axis=2)
    return _encoded(found)


def steepened(normals: np.ndarray, times: float) -> np.ndarray:
    """Return a map of normals, uint8 (n, n, 3) with z up, of slopes so many times as steep."""
    return _encoded((normals / 127.5 - 1.0) * (times, times, 1.0))


def _encoded(directions: np.ndarray) -> np.ndarray:
    """Return directions (n, n, 3) of any length as a map of normals, uint8."""
    normals = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    return np.rint((normals + 1.0) * 127.5).astype(np.uint8)


@contextmanager
def arrays(points: np.ndarray, half: np.ndarray, coordinates: list[np.ndarray]) -> Iterator[None]:
    """Enable the arrays of points (n, 3), of half vectors (n, 3) as colours, and of coordinates.

    All are float32.
    """
    # A component of -1..1 becomes a colour of 0..1, which GL_DOT3 turns back.
    colours = np.ascontiguousarray((half * 0.5 + 0.5)[:, [0, 2, 1]])
    gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, points)
    gl.glEnableClientState(gl.GL_COLOR_ARRAY)
    gl.glColorPointer(3, gl.GL_FLOAT, 0, colours)
    for unit, array in enumerate(coordinates):
        gl.glClientActiveTexture(int(gl.GL_TEXTURE0) + unit)
        gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        gl.glTexCoordPointer(array.shape[1], gl.GL_FLOAT, 0, array)

    try:
        yield
    finally:
        gl.glPopClientAttrib()
