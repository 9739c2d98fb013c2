"""The sword whose blade is geometry at rest: smooth edges, and steel that is a mirror.

A picture of 512 texels that is stretched over 1,350 pixels has soft, stepped edges, whatever the
number of samples: they are in its alpha. Here the blade is a mesh: a flattened rhomb in section,
with a fuller along two thirds of it and a ground edge. It has the place and direction that the
picture shows (KEY), and is projected to the picture's square once. Its outline is widened by a
pixel's breadth whose alpha falls to 0, so the edge is smooth without multisampling, too.
Technique of the steel: unit 0 is a cube map of what is around, looked up by the mirrored line of
sight (GL_REFLECTION_MAP) and turned with the walker, times the current colour; unit 1 multiplies
by fine scratches. Of the picture only hand and hilt remain; a stroke shows the pictures, which are
blurred by motion.
Not in the report; switch ``overlay.blade``. Where OpenGL has no cube maps, the blade is painted.
State used: as shining_sword.py.
"""

import math
from functools import partial

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, matrix
from framelens.gl.texture import Texture
from landscape.elements.best.sky import surroundings
from landscape.elements.best.sword.shining_sword import ASPECT, GLARE, TAN, ShiningSword
from landscape.elements.settings import Settings
from landscape.elements.sun import direction, painted
from landscape.elements.sword import pictures
from landscape.files.assets import Assets
from landscape.files.cache import content, recall
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh, grid_triangles
from landscape.gl.cube_map import CubeMap, face_directions, generate, texture_matrix
from landscape.gl.display_list import DisplayList
from landscape.gl.features import possible

# The camera and the pose at rest of the picture (studio/castle/sword.py): place of the grip on the
# screen and its depth, direction of the blade, direction of its edge.
TAN_HALF = 0.466
KEY = (0.66, -0.54, 0.62), (0.03, 0.43, -0.62), (0.90, 0.10, 0.30)
ROOT, TIP = 0.096, 0.815  # of the blade along its axis, in the picture's units
FULLER, GROUND = 0.62, 0.26  # chosen: part of the length that has a fuller, of the width ground
ROWS = 40  # chosen
BEND = 0.34  # chosen: radians by which the flats are bent, so that light runs along them
HOLLOW = 2.4  # chosen: times the slope of the flats, as if they were hollow ground
FEATHER = 0.0026  # chosen: breadth of the soft edge, in halves of the picture's height
BARE = 0.135  # above this height along the axis the picture shows nothing but the blade
DARK = 0.55  # chosen: light on the blade next to the guard
EXPONENT, GREY = 1.5, 0.70  # chosen: contrast, and loss of colour, of what steel mirrors
TILES = 16  # chosen: parts of the picture along each side, of which the empty ones are not drawn
SCRATCHES = 256, 64  # chosen: texels along the blade, and across


def pose() -> tuple[np.ndarray, np.ndarray]:
    """Return the axes of the sword, rows (3, 3) in eye space, and its origin (3,) there."""
    (x, y, depth), along, edge = (np.array(part, float) for part in KEY)
    grip = np.array([x * TAN_HALF * ASPECT * depth, y * TAN_HALF * depth, -depth])
    along = along / np.linalg.norm(along)
    edge = edge - along * (edge @ along)
    edge /= np.linalg.norm(edge)
    return np.stack([edge, along, np.cross(edge, along)]), grip


def half_width(share: np.ndarray) -> np.ndarray:
    """Return half the blade's width at shares 0..1 of its length: it tapers to a point."""
    point = np.clip((1.0 - share) / 0.13, 0.0, 1.0) ** 0.7
    return np.asarray((0.030 - 0.009 * share) * point)


def relief(across: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Return the height of the blade's face at ``across`` (-1..1 of its half width)."""
    wide = np.maximum(half_width(share), 1e-5)
    thick = 0.0066 - 0.0022 * share
    rim = 0.45 * thick
    flat = thick - np.abs(across) * (thick - rim)
    edge = 1.6 * rim * (1.0 - np.abs(across)) / GROUND
    depth = 0.0030 * np.clip((FULLER + 0.05 - share) / 0.10, 0.0, 1.0)
    groove = thick - depth + 9.0 * np.square(across * wide)
    return np.minimum(np.minimum(flat, edge), np.maximum(groove, 0.0))


def face() -> Mesh:
    """Return the blade's visible face in the sword's own frame: strips between its creases.

    x to the edge, y along the blade, z outwards; coordinates run along and across. The strips do
    not share vertices, so that their normals differ at a crease.
    """
    creases = (-1.0, -0.80, -0.36, 0.36, 0.80, 1.0)
    share = np.linspace(0.0, 1.0, ROWS + 1)
    share = 1.0 - (1.0 - share) ** 1.25  # more rows where the outline is curved
    vertices = []
    normals = []
    triangles = []
    coordinates = []
    first = 0
    for left, right in zip(creases, creases[1:], strict=False):
        columns = 9 if left == -0.36 else 2
        u, v = np.meshgrid(np.linspace(left, right, columns), share)
        wide = half_width(v)
        z = relief(u, v)
        y = ROOT + v * (TIP - ROOT)
        inner = np.clip(u, left + 0.02, right - 0.02)
        slope = (relief(inner + 0.01, v) - relief(inner - 0.01, v)) / (
            0.02 * np.maximum(wide, 1e-4)
        )
        tilt = np.stack([-HOLLOW * slope, np.sin(BEND * (2 * v - 1)), np.ones_like(u)], axis=-1)
        vertices.append(np.stack([u * wide, y, z], axis=-1).reshape(-1, 3))
        normals.append((tilt / np.linalg.norm(tilt, axis=-1, keepdims=True)).reshape(-1, 3))
        coordinates.append(np.stack([3.0 * v, (u + 1) / 2], axis=-1).reshape(-1, 2))
        triangles.append(grid_triangles(columns, ROWS + 1) + np.uint32(first))
        first += columns * (ROWS + 1)

    return Mesh(
        np.concatenate(vertices),
        np.concatenate(normals),
        np.concatenate(triangles).astype(np.uint32),
        (np.concatenate(coordinates),),
    )


def on_square(points: np.ndarray) -> np.ndarray:
    """Return where points (n, 3) of eye space are in the picture's square -1..1, (n, 2)."""
    return np.asarray(points[:, :2] / -points[:, 2:] / (TAN_HALF * ASPECT, TAN_HALF))


def steel_mesh() -> Mesh:
    """Return the blade in the picture's square at z = -1, with normals, colours and coordinates.

    Colours, float32 (n, 4), are light and opacity. Normals are stretched as those of strip() in
    shining_sword.py.
    """
    axes, grip = pose()
    blade = face()
    if axes[2] @ grip > 0:  # the other side of the blade is the one that is seen
        mirror = np.array([1.0, 1.0, -1.0])
        blade = Mesh(
            blade.vertices * mirror, blade.normals * mirror, blade.triangles, blade.coordinates
        )
    square = on_square(blade.vertices @ axes + grip)
    normals = blade.normals @ axes
    share = (blade.vertices[:, 1] - ROOT) / (TIP - ROOT)
    groove = (np.abs(blade.vertices[:, 0]) < 0.36 * half_width(share)) & (share < FULLER)
    light = np.clip(DARK + 9.0 * share, 0.0, 1.0) * np.where(groove, 0.80, 1.0)
    colours = np.ones((len(square), 4))
    colours[:, :3] = light[:, None]

    border, border_colours, scratch = soft_edge(axes, grip)
    facing = np.tile(normals[0], (len(border), 1))
    strip = grid_triangles(len(border) // 2, 2) + np.uint32(len(square))

    flat = np.concatenate([square, border])
    turned = np.concatenate([normals, facing]) * (ASPECT, 1.0, 1.0 / TAN)
    return Mesh(
        np.ascontiguousarray(np.column_stack([flat, -np.ones(len(flat))]), np.float32),
        np.ascontiguousarray(turned, np.float32),
        np.ascontiguousarray(np.concatenate([blade.triangles, strip]), np.uint32),
        (np.ascontiguousarray(np.concatenate([blade.coordinates[0], scratch]), np.float32),),
        np.ascontiguousarray(np.concatenate([colours, border_colours]), np.float32),
    )


def soft_edge(axes: np.ndarray, grip: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return two rows of vertices: the blade's outline, and beside it the same with no opacity.

    They are places in the picture's square (n, 2), colours (n, 4) and coordinates (n, 2).
    """
    rim = np.linspace(0.0, 1.0, ROWS + 1)
    rim = 1.0 - (1.0 - rim) ** 1.25
    line = np.concatenate([rim, rim[-2::-1]])
    side = np.concatenate([np.ones(ROWS + 1), -np.ones(ROWS)])
    edge = np.stack([side * half_width(line), ROOT + line * (TIP - ROOT), 0 * line], axis=1)
    at = on_square(edge @ axes + grip) * (ASPECT, 1.0)

    # Outwards: at right angles to the outline, away from its middle.
    along = np.gradient(at, axis=0)
    out = np.stack([along[:, 1], -along[:, 0]], axis=1)
    out /= np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-9)
    middle = at.mean(axis=0)
    out *= np.sign(((at - middle) * out).sum(axis=1).mean())
    places = np.concatenate([at, at + FEATHER * out]) / (ASPECT, 1.0)

    shade = np.tile(np.clip(DARK + 9.0 * line, 0.0, 1.0)[:, None], (2, 3))
    opacity = np.repeat([1.0, 0.0], len(at))[:, None]
    scratch = np.column_stack([3.0 * line, (side + 1) / 2])
    return places, np.column_stack([shade, opacity]), np.concatenate([scratch, scratch])


def without_blade(picture: np.ndarray) -> np.ndarray:
    """Return the picture of the sword at rest, uint8 (h, w, 4), without its blade.

    Above BARE all of it goes; next to the guard what is as blue as steel.
    """
    axes, grip = pose()
    height, width = picture.shape[:2]
    y, x = np.mgrid[0:height, 0:width]
    at = np.stack([((x + 0.5) / width * 2 - 1) * ASPECT, 1 - (y + 0.5) / height * 2], axis=-1)
    ends = on_square(np.array([[0.0, BARE, 0.0], [0.0, TIP, 0.0]]) @ axes + grip) * (ASPECT, 1.0)
    way = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    along = (at - ends[0]) @ way
    off = (at - ends[0]) @ np.array([-way[1], way[0]])
    colours = picture[..., :3].astype(np.float32)
    blue = (colours[..., 2] - colours[..., 0]) / np.maximum(colours.max(axis=2), 1.0)
    steel = np.clip((blue + 0.02) / 0.04, 0.0, 1.0) * (along > -0.085)
    gone = np.where(along > 0.0, 1.0, steel) * (np.abs(off) < 0.16)
    out = picture.copy()
    out[..., 3] = np.rint(picture[..., 3] * (1.0 - gone))
    return out


def finer(picture: np.ndarray) -> np.ndarray:
    """Return a picture, uint8 (h, w, 4), with twice as many texels a side, (2h, 2w, 4).

    Interpolated by Catmull and Rom's cubics between the texels' middles, premultiplied: where
    OpenGL interpolates linearly, a slanting edge that is one texel wide gets steps.
    """
    alpha = picture[..., 3:].astype(np.float32) / 255
    values = np.concatenate([picture[..., :3] * alpha, 255 * alpha], axis=2)
    for axis in (0, 1):
        padded = np.concatenate(
            [values.take([0, 0], axis), values, values.take([-1, -1], axis)], axis
        )
        count = values.shape[axis]
        taps = [padded.take(range(k, k + count), axis) for k in range(5)]
        # A quarter of a texel before each middle, and a quarter after it.
        before = [-0.0703125, 0.8671875, 0.2265625, -0.0234375]
        early = (
            before[3] * taps[0] + before[2] * taps[1] + before[1] * taps[2] + before[0] * taps[3]
        )
        late = before[0] * taps[1] + before[1] * taps[2] + before[2] * taps[3] + before[3] * taps[4]
        both = np.stack([early, late], axis=axis + 1)
        shape = list(values.shape)
        shape[axis] *= 2
        values = both.reshape(shape)

    cover = np.clip(values[..., 3:], 0, 255)
    colours = np.clip(values[..., :3] / np.maximum(cover / 255, 1e-3), 0, 255)

    # Where nothing is covered, the colour of what is near must remain.
    near = np.repeat(np.repeat(picture[..., :3], 2, axis=0), 2, axis=1)
    colours = np.where(cover > 8, colours, near)
    return np.rint(np.concatenate([colours, cover], axis=2)).astype(np.uint8)


def covered(alpha: np.ndarray) -> np.ndarray:
    """Return which of TILES by TILES parts of a picture show something, bool, row 0 at its top.

    ``alpha`` is uint8 (h, w). The neighbours of such a part count, too: mip levels blend into them.
    """
    inside = np.zeros((TILES + 2, TILES + 2), bool)
    rows, columns = (np.arange(side) * TILES // side + 1 for side in alpha.shape)
    np.logical_or.at(inside, (rows[:, None], columns), alpha > 0)
    near = [np.roll(inside, (down, right), (0, 1)) for down in (-1, 0, 1) for right in (-1, 0, 1)]
    return np.asarray(np.any(near, axis=0)[1:-1, 1:-1])


def send_covered(alpha: np.ndarray) -> None:
    """Send the parts of :func:`gl.draw.picture_quad` in which a picture of ``alpha`` (h, w) shows.

    Most of the sword's square is empty, and to blend nothing costs as much as to blend something.
    """
    gl.glBegin(gl.GL_QUADS)
    for row, column in np.argwhere(covered(alpha)).tolist():
        for right, down in ((0, 1), (1, 1), (1, 0), (0, 0)):
            s, t = (column + right) / TILES, (row + down) / TILES
            gl.glTexCoord2f(s, t)
            gl.glVertex3f(2.0 * s - 1.0, 1.0 - 2.0 * t, -1.0)
    gl.glEnd()


def scratches() -> np.ndarray:
    """Return fine scratches along and across the blade, uint8 (h, w, 1), near white."""
    along, across = SCRATCHES
    rng = np.random.default_rng(11)
    picture = np.ones((across, along))
    x, y = np.meshgrid(np.arange(along), np.arange(across))
    for _ in range(110):
        turn = rng.normal(0.0, 0.5) if rng.random() < 0.75 else rng.uniform(-1.5, 1.5)
        cx = rng.uniform(0, along)
        cy = rng.uniform(0, across)
        long = rng.gamma(2.0, 9.0)
        dx, dy = (x - cx + along / 2) % along - along / 2, y - cy
        u, v = dx * math.cos(turn) + dy * math.sin(turn), dy * math.cos(turn) - dx * math.sin(turn)
        line = np.exp(-((v / 0.6) ** 2)) * np.clip(1.0 - np.abs(u) / long, 0.0, 1.0)
        picture -= rng.uniform(0.05, 0.22) * line
    picture -= 0.05 * rng.random((across, 1))  # the grain of the grinding runs along the blade
    return np.asarray(np.clip(picture, 0.4, 1.0) * 255, np.uint8)[..., None]


def mirrored_light(settings: Settings, assets: Assets) -> np.ndarray:
    """Return the faces of a cube map of what polished steel mirrors, uint8 (6, n, n, 3)."""
    around = (surroundings.surroundings(settings, assets) / np.float32(255)) ** EXPONENT
    around += (around.mean(axis=-1, keepdims=True) - around) * GREY
    away = np.arccos(np.clip(face_directions(around.shape[1]) @ direction(settings.sun), -1, 1))
    glare = np.exp(-((away / GLARE) ** 2))[..., None] * np.array(settings.sun.diffuse)
    return np.rint(np.clip(0.10 + 1.45 * around + glare, 0.0, 1.0) * 255).astype(np.uint8)


class SteelBlade(ShiningSword):
    """The sword with a blade of geometry at rest."""

    asked_by = ("overlay.blade",)

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Compile the blade, and cut it out of the picture."""
        super().__init__(settings, assets)
        self._blade: DisplayList | None = None
        self._covered: DisplayList | None = None
        self._owned: list[Texture | CubeMap] = []
        if self._around is None or not possible("overlay.blade"):
            return
        path = pictures(assets)[0]
        (cut,) = recall(["hilt", content(path)], lambda: (finer(without_blade(read_image(path))),))
        hilt = Texture(cut, repeat=False)
        (scratched,) = recall(["scratches"], lambda: (scratches(),))
        self._hilt, self._scratched = hilt, Texture(scratched)
        self._mirrored = CubeMap(mirrored_light(settings, assets))
        self._owned = [hilt, self._scratched, self._mirrored]
        self._covered = DisplayList(partial(send_covered, cut[..., 3]))
        self._blade = DisplayList(self._send_blade)

    @staticmethod
    def _send_blade() -> None:
        mesh = steel_mesh()
        # Unit 0 generates its coordinates; the mesh's own are for unit 1.
        none = np.zeros_like(mesh.coordinates[0])
        with client_arrays(mesh.vertices, mesh.normals, mesh.colors, [none, *mesh.coordinates]):
            gl.glDrawElements(
                gl.GL_TRIANGLES, mesh.triangles.size, gl.GL_UNSIGNED_INT, mesh.triangles
            )

    def draw(self, frame: Frame) -> None:
        """Draw blade and hilt; in a stroke the pictures."""
        if frame.stroke or self._blade is None or self._covered is None:
            super().draw(frame)
            return
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT
        with attrib(groups), matrix():
            self._place(frame)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glEnable(gl.GL_NORMALIZE)
            with attrib(gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT):
                gl.glActiveTexture(gl.GL_TEXTURE1)
                gl.glEnable(gl.GL_TEXTURE_2D)
                self._scratched.bind()
                gl.glActiveTexture(gl.GL_TEXTURE0)
                gl.glEnable(gl.GL_TEXTURE_CUBE_MAP)
                self._mirrored.bind()
                generate("REFLECTION_MAP")
                with texture_matrix(frame.to_world):
                    self._blade.call()

            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glColor3f(*painted(self.settings.sun, self._facing(frame)))
            self._hilt.bind()
            self._covered.call()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete lists, textures and maps; may be called twice."""
        super().release()
        for each in (self._blade, self._covered, *self._owned):
            if each is not None:
                each.release()
