"""Fur as shells around an animal's mesh, and a glint in its eyes (``rabbit.fur``).

Technique: the mesh is drawn again a few times, each time blown up a little further along its
normals and combed backwards. One texture holds the height of a hair at each texel; the alpha test
cuts away, in each shell, the hairs that do not reach it. So hairs are cones of a few layers, and
the silhouette is ragged. Each shell is a display list. Shells (Lengyel and others 2001,
"Real-time fur over arbitrary surfaces") are not in the report.
What is wrong with it: seen along the surface, the layers are separate; so they are close together,
and where hairs are shorter than a pixel or two, fewer and fewer are drawn.
State used: GL_ALPHA_TEST, GL_TEXTURE_2D; the glint is an unlit, untextured disc.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib
from framelens.gl.texture import Texture
from landscape.elements.best.animals.axis_mapping import by_axis
from landscape.elements.best.animals.levels_of_detail import packed, unpacked
from landscape.files.cache import recall
from landscape.geometry.clustering import clustered
from landscape.geometry.mesh import Mesh, gathered, scaled
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh

# All chosen; lengths are those of a mesh of -1..1.
SPARSE = 0.6  # how much of what is above a shell's cut is cut where hair begins to be seen
LENGTH = 0.038  # of the longest hair
COMBED = np.array([-1.0, -0.75, 0.0])  # where hairs point, times their length; the head is at +x
CUBE = 0.055  # side of the cubes whose vertices are merged before shells are made
REPEAT = 4.5  # textures of hairs over 2 units
# The texture: texels a side, hairs, and the radius of their roots in texels.
SIDE = 128
HAIRS = 3600
THICK = (1.0, 2.2)

ROOT, TIP = 0.70, 1.14  # brightness of the lowest and of the highest shell
DARK, BARE = 50, 0.06  # mean colour under which a vertex is an eye; how far the bald reaches
PINK = (35, 46)  # red minus green of skin: from the first on hairs get shorter
APPEARS = (0.5, 1.5)  # pixels: a shorter hair is not drawn, from the other on all are
TONES = (0.66, 1.0)  # of hairs
FEET = (-0.86, -0.60)  # heights between which hairs get longer, from half of it
GLINT, GLINT_CORNERS = 0.013, 10  # radius of the disc in an eye, and its corners
SKYWARD = np.array([0.25, 0.70, 0.0])  # where on an eye the glint is, from its middle


def hair_texture(seed: int = 7) -> np.ndarray:
    """Return tileable hairs, uint8 (SIDE, SIDE, 4): grey tones, and alpha the height of a hair."""
    rng = np.random.default_rng(seed)
    at = np.arange(SIDE)
    height, tone = np.zeros((SIDE, SIDE)), np.full((SIDE, SIDE), 0.9)
    for x, y in rng.uniform(0, SIDE, (HAIRS, 2)):
        dx = (at - x + SIDE / 2) % SIDE - SIDE / 2
        dy = (at - y + SIDE / 2) % SIDE - SIDE / 2
        near_x, near_y = np.flatnonzero(np.abs(dx) < 3), np.flatnonzero(np.abs(dy) < 3)
        away = np.hypot(dx[near_x], dy[near_y][:, None])
        cone = rng.uniform(0.45, 1.0) * np.clip(1.0 - away / rng.uniform(*THICK), 0.0, 1.0) ** 0.6
        own = np.ix_(near_y, near_x)
        higher = cone > height[own]
        height[own] = np.where(higher, cone, height[own])
        tone[own] = np.where(higher, rng.uniform(*TONES), tone[own])
    return np.rint(255 * np.stack([tone, tone, tone, height], axis=2)).astype(np.uint8)


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

    ``eyes_at`` are the :func:`eyes`.
    """
    low, high = FEET
    lengths = 0.4 + 0.6 * np.clip((mesh.vertices[:, 1] - low) / (high - low), 0.0, 1.0)
    if mesh.colors is not None:
        red, green = mesh.colors[:, 0].astype(float), mesh.colors[:, 1].astype(float)
        lengths *= 1.0 - 0.85 * np.clip((red - green - PINK[0]) / (PINK[1] - PINK[0]), 0, 1)
    for middle, _ in eyes_at:
        away = np.linalg.norm(mesh.vertices - middle, axis=1)
        lengths *= np.clip((away - BARE) / BARE, 0.0, 1.0)
    return lengths


def laid(mesh: Mesh) -> Mesh:
    """Return a coarser mesh of -1..1 with the coordinates of the texture of hairs.

    Hairs hide how coarse it is, and most of the time goes into the number of triangles.
    """
    return gathered(by_axis(clustered(mesh, CUBE), REPEAT))


def shells(skin: Mesh, eyes_at: list[tuple[np.ndarray, np.ndarray]], count: int) -> list[Mesh]:
    """Return ``count`` shells of a mesh that was :func:`laid`, from the skin outwards.

    ``eyes_at`` are the :func:`eyes`. All shells have the coordinates of the skin, so that a hair
    goes straight through them.
    """
    lengths = (LENGTH * hair_lengths(skin, eyes_at))[:, None]
    # Hairs lie along the skin: only what of COMBED is in its plane.
    along = COMBED - (skin.normals @ COMBED)[:, None] * skin.normals
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
        drawn = repr((SIDE, HAIRS, THICK, TONES))
        self._texture = Texture(recall(("hairs", drawn), lambda: (hair_texture(),))[0])
        lay = recall(("fur", repr((REPEAT, CUBE)), source), lambda: packed({0.0: laid(mesh)}))
        layers = [scaled(shell, scale) for shell in shells(unpacked(lay)[0.0], eyes(mesh), count)]
        discs = (glints(mesh) * scale).astype(np.float32)
        self._lists = [DisplayList(partial(draw_mesh, layer)) for layer in layers]
        self._glint = DisplayList(lambda: send_discs(discs))

    def seen(self, pixels: float) -> float:
        """Return how much of the fur is seen, 0..1, where a unit has this many ``pixels``."""
        least, all_seen = APPEARS
        return min(max((self._hair * pixels - least) / (all_seen - least), 0.0), 1.0)

    def draw(self, seen: float) -> None:
        """Draw as much as is ``seen`` in the place and light that are set.

        The current colour is changed.
        """
        with attrib(gl.GL_COLOR_BUFFER_BIT | gl.GL_ENABLE_BIT):
            gl.glEnable(gl.GL_ALPHA_TEST)
            self._texture.bind()
            for k, layer in enumerate(self._lists):
                cut = (k + 0.5) / (len(self._lists) + 1)
                gl.glAlphaFunc(gl.GL_GREATER, cut + SPARSE * (1.0 - seen) * (1.0 - cut))
                layer.call()
            gl.glDisable(gl.GL_ALPHA_TEST)
            gl.glDisable(gl.GL_LIGHTING)
            gl.glDisable(gl.GL_TEXTURE_2D)
            gl.glColor3f(1.0, 1.0, 1.0)
            self._glint.call()

    def release(self) -> None:
        """Delete the lists and the texture; may be called twice."""
        for each in (*self._lists, self._glint):
            each.release()
        self._texture.release()


def send_discs(discs: np.ndarray) -> None:
    """Send discs (k, n, 3), each a fan."""
    for disc in discs:
        gl.glBegin(gl.GL_TRIANGLE_FAN)
        for corner in disc:
            gl.glVertex3f(*map(float, corner))
        gl.glEnd()
