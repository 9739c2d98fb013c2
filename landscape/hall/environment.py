"""What the statue mirrors: the hall around it, as a cube map or a sphere map (glSkel, environment).

Technique: the hall is drawn once from the statue's place into the six faces of a cube map
(GL_ARB_texture_cube_map, OpenGL 1.3). A gilded surface is drawn with coordinates that OpenGL
generates from the reflection vector r of the line of sight at each vertex:
- ``statue.environment=cube``: GL_REFLECTION_MAP takes r itself as the direction in the cube map. r
  is in eye space; the texture matrix, the camera's rotation backwards, turns it into the hall's.
- sphere: GL_SPHERE_MAP (OpenGL 1.0) looks r up in the picture of a small mirror ball. That picture
  belongs to one line of sight: here it is made again in every frame, as a disc drawn with the
  directions that a ball mirrors, from the cube map. One a frame is enough: in the floor's mirror
  image, where the line of sight is another, the statue takes the cube map.
What is wrong with a sphere map: without ``statue.fresh`` there is one picture, as in 1997, that for
a view to the north, and what the statue mirrors turns with whoever walks around it. All that is
behind the ball lies on the picture's rim, in few texels; and both maps show the hall from one
point, so that no part of the statue mirrors another.
Without ``statue.generated`` no coordinates are generated, as by a program with the printed
glEnable(GL_GEN_S): every vertex looks up the same texel.
State used: GL_TEXTURE_CUBE_MAP or GL_TEXTURE_2D with generated coordinates, the texture matrix,
GL_COMBINE; while the maps are made, framebuffer objects.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import gl
from framelens.gl.state import attrib, combine, flat_projection
from landscape.frame import Frame, Pose
from landscape.gl.cube_map import CubeMap, generate, texture_matrix
from landscape.gl.features import possible
from landscape.gl.texture_target import TextureTarget
from landscape.hall.settings import Settings

FACE, BALL = 128, 128  # chosen: sides of a face of the cube map and of the sphere map, in texels
NEAR, FAR = 0.02, 40.0  # chosen: units
RINGS, SIDES = 16, 32  # chosen: of the disc that the sphere map is drawn with

NORTHWARDS = np.eye(3)  # the rotation to the hall's axes from those of an eye that looks north

# The camera of each face, in OpenGL's order: a face's picture has its first row at t = 0, so that
# the cameras of the sides are upside down.
FACES = {
    "POSITIVE_X": (90.0, 0.0, 180.0),
    "NEGATIVE_X": (270.0, 0.0, 180.0),
    "POSITIVE_Y": (0.0, 90.0, 0.0),
    "NEGATIVE_Y": (0.0, -90.0, 0.0),
    "POSITIVE_Z": (180.0, 0.0, 180.0),
    "NEGATIVE_Z": (0.0, 0.0, 180.0),
}


def sphere_coordinates(normals: np.ndarray, sight: np.ndarray) -> np.ndarray:
    """Return GL_SPHERE_MAP's s and t (n, 2) for unit normals and lines of sight (n, 3), eye space.

    With r = u - 2 n (n . u) and m = 2 sqrt(rx^2 + ry^2 + (rz + 1)^2): s = rx/m + 1/2 and
    t = ry/m + 1/2 (OpenGL 1.5, section 2.11.4).
    """
    mirrored = sight - 2 * normals * (normals * sight).sum(axis=1, keepdims=True)
    m = 2 * np.linalg.norm(mirrored + (0.0, 0.0, 1.0), axis=1, keepdims=True)
    return np.asarray(mirrored[:, :2] / m + 0.5)


def ball_directions(places: np.ndarray) -> np.ndarray:
    """Return what a mirror ball of radius 1 mirrors at places x, y (n, 2) of its picture, (n, 3).

    Eye space, seen from far away: the inverse of GL_SPHERE_MAP. The rim mirrors what is behind.
    """
    x, y = places.T
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0.0))
    return np.stack([2 * z * x, 2 * z * y, 2 * z * z - 1], axis=1)


def disc() -> tuple[np.ndarray, np.ndarray]:
    """Return the places (n, 2) and the triangles (m, 3) of a disc that reaches beyond radius 1.

    Its rings are closer to each other near the rim, where the directions change fastest.
    """
    radius = np.append(np.sin(np.linspace(0, np.pi / 2, RINGS)), 1.5)
    angle = np.arange(SIDES + 1) / SIDES * 2 * np.pi
    places = radius[:, None, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    ring, side = np.mgrid[:RINGS, :SIDES].reshape(2, -1)
    corner = ring * (SIDES + 1) + side
    beyond = corner + SIDES + 1
    quads = np.stack([corner, beyond, beyond + 1, corner, beyond + 1, corner + 1], axis=1)
    return places.reshape(-1, 2), quads.reshape(-1, 3).astype(np.uint32)


def make_levels(kind: int, name: int) -> None:
    """Make the mip levels of a map: without them far scales glitter, as each mirrors much."""
    gl.glBindTexture(kind, name)
    gl.glTexParameteri(kind, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR_MIPMAP_LINEAR)
    gl.glGenerateMipmap(kind)
    gl.glBindTexture(kind, 0)


def camera(pose: Pose, side: int) -> Frame:
    """Set a camera whose view is one face of a cube, 90 degrees wide; return its frame."""
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    gl.glFrustum(-NEAR, NEAR, -NEAR, NEAR, NEAR, FAR)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    gl.glRotatef(-pose.roll, 0.0, 0.0, 1.0)
    gl.glRotatef(-pose.pitch, 1.0, 0.0, 0.0)
    gl.glRotatef(pose.yaw, 0.0, 1.0, 0.0)
    assert pose.y is not None
    gl.glTranslatef(-pose.x, -pose.y, -pose.z)
    modelview = np.array(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX), np.float64).ravel()
    return Frame(pose, (side, side), 0.0, modelview, 90.0)


def cube_around(
    place: tuple[float, float, float],
    side: int,
    draw: Callable[[Frame], None],
    faces: Sequence[str] = tuple(FACES),
) -> CubeMap:
    """Return a cube map of ``side`` texels of what ``draw`` draws around a place.

    Of FACES only ``faces`` are drawn; the others stay black. "pool.mirrors" must be possible.
    """
    target = TextureTarget((side, side))
    cube = CubeMap(np.zeros((6, side, side, 3), np.uint8))
    groups = gl.GL_ENABLE_BIT | gl.GL_LIGHTING_BIT | gl.GL_COLOR_BUFFER_BIT
    for name in faces:
        with target.drawing(clear=False), attrib(groups), flat_projection():
            draw(camera(Pose(*place, *FACES[name]), side))
            cube.bind()
            face = gl_constant(f"GL_TEXTURE_CUBE_MAP_{name}")
            gl.glCopyTexSubImage2D(face, 0, 0, 0, 0, 0, side, side)
            gl.glBindTexture(gl.GL_TEXTURE_CUBE_MAP, 0)

    target.release()
    make_levels(gl.GL_TEXTURE_CUBE_MAP, cube.name)
    return cube


class Environment:
    """The maps of what is around a place, and their use."""

    def __init__(
        self,
        settings: Settings,
        place: tuple[float, float, float],
        draw: Callable[[Frame], None],
        face: int = FACE,
        ball: int = BALL,
    ) -> None:
        """Draw the surroundings of ``place`` into the cube map; ``draw`` draws all but the statue.

        ``face`` and ``ball`` are the sides of a face and of the sphere map, in texels.
        "pool.mirrors" must be possible.
        """
        self.settings = settings
        self._drawn_for: np.ndarray = np.zeros(0)
        self.cube = cube_around(place, face, draw)
        self._ball = TextureTarget((ball, ball))
        places, self._triangles = disc()
        self._points = np.zeros((len(places), 3), np.float32)
        self._points[:, :2] = places
        within = places / np.maximum(np.linalg.norm(places, axis=1, keepdims=True), 1.0)
        self._directions = np.ascontiguousarray(ball_directions(within), np.float32)

    def prepare(self, frame: Frame) -> None:
        """Make the sphere map of a frame's line of sight, if it is wanted and not there yet."""
        statue = self.settings.statue
        if statue.environment != "sphere" or frame.mirrored:
            return
        turn = frame.to_world if statue.fresh else NORTHWARDS
        if np.array_equal(turn, self._drawn_for):
            return
        self._drawn_for = turn
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT | gl.GL_COLOR_BUFFER_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_POLYGON_BIT | gl.GL_STENCIL_BUFFER_BIT
        with self._ball.drawing(clear=False), attrib(groups), flat_projection():
            # The map is kept: it must not depend on the frame that happens to need it first, be it
            # a wireframe or one of a walk that is drawn interlaced (walk/stretch.py).
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)
            if possible("sharper textures"):
                gl.glTexEnvf(gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS, 0.0)
            for name in ("DEPTH_TEST", "STENCIL_TEST", "LIGHTING", "CULL_FACE", "CLIP_PLANE0"):
                gl.glDisable(gl_constant(f"GL_{name}"))
            gl.glColor3f(1.0, 1.0, 1.0)
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
            gl.glEnable(gl.GL_TEXTURE_CUBE_MAP)
            self.cube.bind()
            with texture_matrix(turn):
                self._send_disc()

        make_levels(gl.GL_TEXTURE_2D, self._ball.name)

    def _send_disc(self) -> None:
        gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, self._points)
        gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        gl.glTexCoordPointer(3, gl.GL_FLOAT, 0, self._directions)
        count = self._triangles.size
        gl.glDrawElements(gl.GL_TRIANGLES, count, gl.GL_UNSIGNED_INT, self._triangles)
        gl.glPopClientAttrib()

    @contextmanager
    def mirrored_by(self, frame: Frame) -> Iterator[None]:
        """Let the block's surfaces mirror the hall, times twice their lit colour.

        The frame must be prepared.
        """
        cube = self.settings.statue.environment == "cube" or frame.mirrored
        with attrib(gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT):
            kind = gl.GL_TEXTURE_CUBE_MAP if cube else gl.GL_TEXTURE_2D
            (self.cube if cube else self._ball).bind()
            gl.glEnable(kind)
            if self.settings.statue.generated:
                generate(*("REFLECTION_MAP", "STR") if cube else ("SPHERE_MAP", "ST"))
            combine(
                {
                    "COMBINE_RGB": "MODULATE",
                    "SOURCE0_RGB": "TEXTURE",
                    "SOURCE1_RGB": "PRIMARY_COLOR",
                }
            )
            gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, 2.0)
            with texture_matrix(frame.to_world if cube else np.eye(3)):
                yield

    def release(self) -> None:
        """Delete the maps; may be called twice."""
        self.cube.release()
        self._ball.release()
