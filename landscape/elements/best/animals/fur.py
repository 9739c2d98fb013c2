"""Fur as shells around an animal's mesh, and a glint in its eyes (``rabbit.fur``).

Technique: the mesh is drawn again a few times, each time blown up a little further along its
normals and combed backwards. One texture holds hairs that lie along s, and in alpha how high each
is above the skin: its tip higher than its root. Each shell keeps what reaches it, so that hairs
are seen lying over each other, and the silhouette is ragged. On each chart of the mesh s is the
direction in which hairs are combed there. Each shell is a display list. Shells (Lengyel and others
2001, "Real-time fur over arbitrary surfaces") are not in the report.
A hair is as narrow as a pixel, so it needs a soft edge: GL_SUBTRACT takes the shell's height from
the hair's, GL_ALPHA_SCALE makes the difference four times as steep (OpenGL 1.3), and alpha says how
many samples of a pixel are written (see :mod:`landscape.gl.cut_out`).
What is wrong with it: seen along the surface, the layers are separate; so they are close together,
and where hairs are shorter than a pixel or two, fewer and fewer are drawn.
State used: GL_ALPHA_TEST, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_TEXTURE_2D and its environment; the glint
is an unlit, untextured disc.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, combine
from framelens.gl.texture import Texture, mip_levels
from landscape.elements.best.animals.axis_mapping import PLANES, facing, in_charts
from landscape.elements.best.animals.levels_of_detail import packed, unpacked
from landscape.files.cache import recall
from landscape.geometry.clustering import clustered
from landscape.geometry.mesh import Mesh, gathered, scaled
from landscape.gl.cut_out import cut_out
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh

# All chosen; lengths are those of a mesh of -1..1.
SPARSE = 0.6  # how much of what is above a shell's cut is cut where hair begins to be seen
LENGTH = 0.05  # of the longest hair
COMBED = np.array([-1.0, -0.75, 0.0])  # where hairs point, times their length; the head is at +x
EARS = 0.42  # height above which there are only ears
ON_EARS = np.array([-0.7, 0.7, 0.0])  # where hairs point there
CUBE = 0.055  # side of the cubes whose vertices are merged before shells are made
REPEAT = 3.0  # textures of hairs over 2 units
ROOT, TIP = 0.72, 1.12  # brightness of the lowest and of the highest shell
DARK, BARE = 50, 0.06  # mean colour under which a vertex is an eye; how far the bald reaches
PINK = (35, 46)  # red minus green of skin: from the first on hairs get shorter
APPEARS = (0.5, 1.5)  # pixels: a shorter hair is not drawn, from the other on all are
SKIPPED = 3  # where hairs are that short, only every so many-th shell is drawn; no pixel shows it
FEET = (-0.86, -0.60)  # heights between which hairs get longer, from half of it
FACE, SHORT = (0.30, 0.70), 0.45  # x between which hairs get shorter to the nose, and how short
GLINT, GLINT_CORNERS = 0.013, 10  # radius of the disc in an eye, and its corners
SKYWARD = np.array([0.25, 0.70, 0.0])  # where on an eye the glint is, from its middle

# The texture of hairs. Chosen; lengths are in its texels.
SIDE, HAIRS = 256, 9000  # its texels, and how many hairs lie in it
LONG = (14.0, 30.0)  # length
WIDE = (0.7, 1.3)  # half width at the root
BENT = 3.0  # sideways bend
FINER = 2  # times as many texels in which hairs are drawn
LOWEST, BELOW = 0.12, 0.55  # height and brightness of the wool between hairs
# Tints of hairs: buff, grey, black; and how many of a hundred are of each.
TINTS = np.array([(1.0, 0.96, 0.88), (0.88, 0.90, 0.92), (0.50, 0.46, 0.44)])
SHARES = (0.55, 0.27, 0.18)
SOFT = 4.0  # how much steeper a hair's edge is than its height
STRENGTH = 0.5 / SOFT  # how far above a shell half of a pixel's samples are written


def hair_texture(seed: int = 7) -> np.ndarray:
    """Return tileable hairs along the rows, uint8 (SIDE, SIDE, 4): tints, and alpha the height."""
    rng = np.random.default_rng(seed)
    side = SIDE * FINER
    root, across = rng.uniform(0, side, (2, HAIRS, 1, 1))
    length = FINER * rng.uniform(*LONG, (HAIRS, 1, 1))
    bend = FINER * rng.normal(0.0, BENT, (HAIRS, 1, 1))
    half = FINER * rng.uniform(*WIDE, (HAIRS, 1, 1))
    # Hairs of a tuft end together, and are of one brightness.
    tuft = np.sin(2 * np.pi * (2 * root / side + 0.3))
    tuft = tuft * np.sin(2 * np.pi * (3 * across / side + 0.2 * tuft))
    height = np.clip(rng.uniform(0.45, 1.0, (HAIRS, 1, 1)) + 0.15 * tuft, 0.0, 1.0)
    tint = TINTS[rng.choice(len(TINTS), HAIRS, p=SHARES)]
    tint = tint * (rng.uniform(0.78, 1.1, (HAIRS, 1)) + 0.08 * tuft[:, 0])

    t = np.linspace(0.0, 1.0, int(FINER * LONG[1]))[:, None]
    offset = np.arange(-3 * FINER / 2, 3 * FINER / 2 + 1)
    x = root + t * length + 0 * offset
    y = across + bend * t**2 + offset
    profile = 1.0 - np.abs(offset) / np.maximum(half * np.sqrt(1.0 - 0.85 * t), 1e-6)
    reached = height * (0.3 + 0.7 * t) * np.clip(2.0 * profile, 0.0, 1.0)
    shade = 0.72 + 0.36 * t + 0 * profile  # a root is dark

    seen = np.nonzero(reached > LOWEST)
    own = seen[0]
    reached, shade = reached[seen], shade[seen]
    texel = (np.floor(y).astype(int) % side * side + np.floor(x).astype(int) % side)[seen]
    drawn = np.empty((side * side, 4))
    drawn[:, :3], drawn[:, 3] = BELOW, LOWEST
    # Of all hairs over a texel the highest is written last.
    order = np.argsort(reached, kind="stable")
    drawn[texel[order], :3] = (tint[own] * shade[:, None])[order]
    drawn[texel[order], 3] = reached[order]
    fine = drawn.reshape(SIDE, FINER, SIDE, FINER, 4).mean(axis=(1, 3))
    return np.rint(255 * np.clip(fine, 0.0, 1.0)).astype(np.uint8)


def kept_apart(image: np.ndarray) -> list[np.ndarray]:
    """Return the mip levels of a texture of hairs whose heights stay as unlike as in the image.

    In plain levels all hairs would be of one height: the upper shells would be bald from afar.
    """
    spread = image[..., 3].std()
    levels = mip_levels(image)
    for level in levels[1:]:
        height = level[..., 3].astype(float)
        grown = spread / max(float(height.std()), 1.0)
        level[..., 3] = np.clip(height.mean() + grown * (height - height.mean()), 0, 255)
    return levels


def eyes(mesh: Mesh) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return the middle (3,) and the unit normal (3,) of each eye: the dark spots left and right.

    An animal without colours has none.
    """
    if mesh.colors is None:
        return []
    dark = mesh.colors[:, :3].mean(axis=1) < DARK
    found = []
    for side in (mesh.vertices[:, 2] > 0, mesh.vertices[:, 2] < 0):
        own = dark & side
        if own.any():
            normal = mesh.normals[own].mean(axis=0)
            found.append((mesh.vertices[own].mean(axis=0), normal / np.linalg.norm(normal)))
    return found


def hair_lengths(mesh: Mesh, eyes_at: list[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """Return the length (n,) 0..1 of the hair at each vertex: none on eyes, little on pink skin.

    ``eyes_at`` are the :func:`eyes`. Feet, face and ears have short hair.
    """
    low, high = FEET
    lengths = 0.4 + 0.6 * np.clip((mesh.vertices[:, 1] - low) / (high - low), 0.0, 1.0)
    behind, front = FACE
    face = np.clip((mesh.vertices[:, 0] - behind) / (front - behind), 0.0, 1.0)
    face *= mesh.vertices[:, 1] > 0.0
    lengths *= 1.0 - (1.0 - SHORT) * np.maximum(face, mesh.vertices[:, 1] > EARS)
    if mesh.colors is not None:
        red, green = mesh.colors[:, 0].astype(float), mesh.colors[:, 1].astype(float)
        lengths *= 1.0 - 0.85 * np.clip((red - green - PINK[0]) / (PINK[1] - PINK[0]), 0, 1)
    for middle, _ in eyes_at:
        away = np.linalg.norm(mesh.vertices - middle, axis=1)
        lengths *= np.clip((away - BARE) / BARE, 0.0, 1.0)
    return lengths


def combed_planes(combed: np.ndarray) -> np.ndarray:
    """Return the directions of s and t (3, 2, 3) in the charts of x, y and z.

    s is the direction ``combed`` (3,), as far as it is in the plane of the chart, and t is across.
    """
    planes = np.empty_like(PLANES)
    for axis in range(3):
        along = np.where(np.arange(3) == axis, 0.0, combed)
        planes[axis, 0] = along / np.linalg.norm(along)
        planes[axis, 1] = np.cross(np.eye(3)[axis], planes[axis, 0])
    return planes


def laid(mesh: Mesh) -> Mesh:
    """Return a coarser mesh of -1..1 with the coordinates of the texture of hairs.

    Hairs hide how coarse it is, and most of the time goes into the number of triangles.
    """
    coarse = clustered(mesh, CUBE)
    ears = coarse.vertices[coarse.triangles, 1].mean(axis=1) > EARS
    planes = np.concatenate([combed_planes(COMBED), combed_planes(ON_EARS)])
    return gathered(in_charts(coarse, facing(coarse) + 3 * ears, planes, REPEAT))


def shells(skin: Mesh, eyes_at: list[tuple[np.ndarray, np.ndarray]], count: int) -> list[Mesh]:
    """Return ``count`` shells of a mesh that was :func:`laid`, from the skin outwards.

    ``eyes_at`` are the :func:`eyes`. All shells have the coordinates of the skin, so that a hair
    goes straight through them.
    """
    lengths = (LENGTH * hair_lengths(skin, eyes_at))[:, None]
    # Hairs lie along the skin: only what of their direction is in its plane.
    combed = np.where(skin.vertices[:, 1:2] > EARS, ON_EARS, COMBED)
    along = combed - (skin.normals * combed).sum(axis=1)[:, None] * skin.normals
    out = []
    for k in range(1, count + 1):
        up = k / count
        moved = skin.vertices + lengths * (up * skin.normals + up**1.6 * along)
        colors = skin.colors
        if colors is not None:
            tone = ROOT + (TIP - ROOT) * up
            colors = np.clip(colors * np.array([tone, tone, tone, 1.0]), 0, 255).astype(np.uint8)
        out.append(replace(skin, vertices=moved.astype(np.float32), colors=colors))
    return out


def glints(mesh: Mesh) -> np.ndarray:
    """Return a disc for each eye, (k, GLINT_CORNERS, 3) in the mesh's own units."""
    discs = []
    for middle, normal in eyes(mesh):
        up = SKYWARD - (SKYWARD @ normal) * normal
        up /= np.linalg.norm(up)
        side = np.cross(normal, up)
        turn = 2 * np.pi * np.arange(GLINT_CORNERS)[:, None] / GLINT_CORNERS
        centre = middle + 1.3 * GLINT * up + 0.9 * GLINT * normal
        discs.append(centre + GLINT * (np.cos(turn) * up + np.sin(turn) * side))
    return np.array(discs).reshape(-1, GLINT_CORNERS, 3)


class Fur:
    """The shells and glints of an animal, scaled to its size on the island."""

    def __init__(self, mesh: Mesh, source: bytes | str, scale: float, count: int) -> None:
        """Make ``count`` shells around a mesh of -1..1 and compile them.

        ``source`` is the cache key of the mesh.
        """
        self._hair = LENGTH * scale
        self._texture = Texture(kept_apart(recall(("hairs",), lambda: (hair_texture(),))[0]))
        lay = recall(("fur", repr((REPEAT, CUBE)), source), lambda: packed({0.0: laid(mesh)}))
        layers = [scaled(shell, scale) for shell in shells(unpacked(lay)[0.0], eyes(mesh), count)]
        discs = (glints(mesh) * scale).astype(np.float32)
        self._lists = [DisplayList(partial(draw_mesh, layer)) for layer in layers]
        self._glint = DisplayList(lambda: send_discs(discs))

    def seen(self, pixels: float) -> float:
        """Return how much of the fur is seen, 0..1, where a unit has this many ``pixels``."""
        least, all_seen = APPEARS
        return min(max((self._hair * pixels - least) / (all_seen - least), 0.0), 1.0)

    def drawn(self, seen: float) -> list[tuple[int, DisplayList]]:
        """Return the shells to draw, by their numbers: the outermost always."""
        every = 1 + round((SKIPPED - 1) * (1.0 - seen))
        numbered = list(enumerate(self._lists))
        return numbered[(len(numbered) - 1) % every :: every]

    def draw(self, seen: float) -> None:
        """Draw as much as is ``seen`` in the place and light that are set.

        The current colour is changed.
        """
        with cut_out(), attrib(gl.GL_TEXTURE_BIT):
            self._texture.bind()
            combine_heights()
            for k, layer in self.drawn(seen):
                cut = (k + 0.5) / (len(self._lists) + 1)
                cut += SPARSE * (1.0 - seen) * (1.0 - cut)
                least = np.array((0.0, 0.0, 0.0, max(cut - STRENGTH, 0.0)), np.float32)
                gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, least)
                layer.call()
        with attrib(gl.GL_ENABLE_BIT):
            gl.glDisable(gl.GL_LIGHTING)
            gl.glDisable(gl.GL_TEXTURE_2D)
            gl.glColor3f(1.0, 1.0, 1.0)
            self._glint.call()

    def release(self) -> None:
        """Delete the lists and the texture; may be called twice."""
        for each in (*self._lists, self._glint):
            each.release()
        self._texture.release()


def combine_heights() -> None:
    """Let alpha be SOFT times the texture's alpha less the alpha of GL_TEXTURE_ENV_COLOR."""
    combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "TEXTURE", "SRC1_RGB": "PRIMARY_COLOR"})
    combine({"COMBINE_ALPHA": "SUBTRACT", "SRC0_ALPHA": "TEXTURE", "SRC1_ALPHA": "CONSTANT"})
    gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_ALPHA_SCALE, SOFT)


def send_discs(discs: np.ndarray) -> None:
    """Send discs (k, n, 3), each a fan."""
    for disc in discs:
        gl.glBegin(gl.GL_TRIANGLE_FAN)
        for corner in disc:
            gl.glVertex3f(*map(float, corner))
        gl.glEnd()
