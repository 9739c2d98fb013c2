"""Run-up: waves that climb the sand, drain, and leave lace and a wet mirror (``water.run_up``).

Technique: a diagram of one place of a beach, distance across and time down, is a texture. It holds
what a swell does there: a front that climbs fast and drains slowly, lace that it leaves behind, a
line of foam where it turned, and sand that is wet at once and dries slowly. Three waves of
different height follow each other. A strip of fine cells along all beaches looks it up: s is how
far up the beach a place is, as a fraction of how far waves reach there; t is when the swell arrives
there, as for the foam on the water (foam.py). The texture matrix moves t with the
time: no vertex changes. Waves reach farther on a level beach, and not equally far along it.
Passes, on the strip only and within FARTHEST of the eye: the ground multiplied by how dark it is;
the sea's mirror image, projected onto it, by Fresnel's alpha and how wet it is; foam, and the weed
that the highest waves have left, both frayed by lace as the foam on the water.
Cost: three layers on the strip; its cells are two triangles for each 0.04 x 0.04 units of beach.
Source: Jensen, Legakis, Dorsey 1999 (wet sand); Fournier and Reeves 1986 (waves ashore).
State used: two texture units and their matrices, GL_BLEND, GL_POLYGON_OFFSET_FILL, no lighting.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, combine, matrix
from framelens.gl.texture import Texture
from landscape.elements.best.sea.foam import COLOUR, FACING, PERIOD, lace, shore_shape, turns
from landscape.elements.best.sea.mirror_image import Taken, projected
from landscape.elements.settings import Settings
from landscape.elements.sun import painted
from landscape.files.cache import recall
from landscape.frame import Frame
from landscape.geometry.culling import boxes_in_view
from landscape.geometry.height_field import HeightField, lookup

HEIGHT = 0.026  # chosen: units above the water that the highest wave climbs on a level beach
LONGEST = 0.24  # chosen: units that waves run up at most
SHORTEST = 0.06  # chosen: units below which a shore is too steep for a strip
UNEVEN = 0.35  # chosen: by which fraction the reach differs along the shore
CELL = 0.04  # chosen: units, side of a cell of the strip
TILE = 2.0  # chosen: units, side of a tile of cells
FARTHEST, FADING = 9.0, 6.0  # chosen: units from the eye to where it is gone, and begins to fade
ABOVE = 0.0006  # chosen: units that the strip lies above the sand
FIRST, LAST = -0.6, 1.4  # chosen: ends of the strip, in reaches above the shoreline
WAVES = (1.0, 0.66, 0.84)  # chosen: how far each of the waves climbs, in reaches
RISING = 0.3  # chosen: fraction of its time that a wave rises
ACROSS, STEPS = 256, 1024  # texels of the diagram, across the beach and in time
HALF_TEXEL = 0.5 / ACROSS * (LAST - FIRST)  # reaches: the texture repeats beyond its ends
DRYING = 1.1  # chosen: waves until the sand is as dry as before
SHINING = 0.45  # chosen: waves until its shine is 1/e
DARKEST = 0.78  # chosen: factor on wet sand, in addition to the band that is always damp
SPREADING = 0.25  # chosen: fraction of its way down in which a wave's foam has spread
LINGERING = 0.6  # chosen: waves until the foam that lies on the sand is 1/e as dense
SHINE = 0.85  # chosen: alpha of the mirror image at a grazing angle
LACE_REPEAT = 5.3  # chosen: tiles of lace per unit
SOFT = 0.035  # chosen: reaches over which sand at the edge of the wet grows dry
WEED = (0.24, 0.19, 0.13)  # chosen: RGB of dry weed
WEED_AT = 1.16  # chosen: reaches above the shoreline, where no wave's foam comes


def front(time: np.ndarray) -> np.ndarray:
    """Return how far up a wave reaches, 0..1, at a fraction 0..1 of its time: fast up, slow down.

    Both are parabolas, as of a body thrown up a slope; the way down takes longer, as sand and
    lower water hold it back.
    """
    up = 1.0 - np.square(1.0 - time / RISING)
    down = 1.0 - np.square((time - RISING) / (1.0 - RISING))
    return np.asarray(np.where(time < RISING, up, down))


def foam_at(place: np.ndarray, time: float, height: float) -> np.ndarray:
    """Return the density of foam, 0..1, at places in reaches of a wave of ``height`` reaches.

    ``time`` is the fraction of the wave's time.
    """
    edge = float(front(np.array(time))) * height
    behind = np.maximum(edge - place, 0.0)
    # Less than one half at the edge itself: it is frayed by lace, and no even line.
    body = 0.06 * np.exp(-behind / 0.10) + 0.28 * np.exp(-behind / 0.6)
    if time < RISING:
        return np.asarray(np.where(place < edge, body, 0.0))
    drained = (time - RISING) / (1.0 - RISING)
    # What the wave has brought spreads while it turns: nowhere does lace appear at once.
    spread = min(drained / SPREADING, 1.0)
    film = (body + spread * (0.28 - body)) * (1.0 - drained) ** 0.6
    left = 0.24 * (1.0 - drained) ** 1.3 * np.exp(-np.maximum(height - place, 0.0) / 0.5)
    mark = 0.11 * (1.0 - drained) ** 0.5 * np.exp(-np.square((height - 0.06 - place) / 0.06))
    foam = np.where(place < edge, film, left) + spread * mark
    return np.asarray(np.where(place < height, foam, 0.0))


@dataclass(frozen=True)
class Diagram:
    """What a swell does to a beach: each (STEPS, ACROSS) of 0..1, time down, distance across."""

    foam: np.ndarray
    wet: np.ndarray
    shine: np.ndarray


def diagram() -> Diagram:
    """Return the diagram of WAVES; its last row continues in its first."""
    place = FIRST + (np.arange(ACROSS) + 0.5) / ACROSS * (LAST - FIRST)
    step = len(WAVES) / STEPS
    foam, wet, shine = np.zeros((3, STEPS, ACROSS))
    now, gloss, lace_left = np.zeros((3, ACROSS))
    for turn in range(2):  # the first time round, what is wet from before is not known
        for k in range(STEPS):
            wave, time = divmod((k + 0.5) * step, 1.0)
            height = WAVES[int(wave)]
            under = place < float(front(np.array(time))) * height
            now = np.where(under, 1.0, np.maximum(now - step / DRYING, 0.0))
            gloss = np.where(under, 1.0, gloss * np.exp(-step / SHINING))
            # Lace lies on the sand until it is gone or the next wave takes it.
            lace_left = np.where(under, 0.0, lace_left * np.exp(-step / LINGERING))
            lace_left = np.maximum(foam_at(place, time, height), lace_left)
            if turn:
                foam[k], wet[k], shine[k] = lace_left, now, gloss
    wet, shine = softer(wet), softer(shine)
    # Farther out the sea has its own foam; at both ends nothing is left.
    inside = np.clip((place - FIRST - 0.05) / 0.5, 0.0, 1.0)
    return Diagram(foam * inside, wet * inside, shine * inside)


def softer(rows: np.ndarray) -> np.ndarray:
    """Return a part of the diagram without hard edges across the beach: sand soaks water up."""
    near = np.arange(-12, 13)
    kernel = np.exp(-0.5 * np.square(near * (LAST - FIRST) / ACROSS / SOFT))
    padded = np.pad(rows, ((0, 0), (12, 12)), mode="edge")
    kernel /= kernel.sum()
    return np.asarray(sum(w * padded[:, k : k + ACROSS] for k, w in enumerate(kernel)))


def reaches(slope: np.ndarray, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return how far waves run up at places x, z, in units, by the slope of the shore there."""
    ragged = np.sin(4.1 * x + 1.3 * np.sin(2.3 * z)) * np.sin(3.7 * z - 1.1 * np.sin(2.9 * x))
    fine = np.sin(13.0 * x + 2.0 * np.sin(9.0 * z)) * np.sin(14.0 * z + 2.0 * np.sin(11.0 * x))
    level = np.minimum(HEIGHT / np.maximum(slope, 1e-3), LONGEST)
    cusps = np.sin(43.0 * x + 3.0 * np.sin(17.0 * z)) * np.sin(39.0 * z + 3.0 * np.sin(19.0 * x))
    return np.asarray(level * (1.0 + UNEVEN * (0.45 * ragged + 0.35 * fine + 0.20 * cusps)))


@dataclass(frozen=True)
class Tile:
    """Cells of the strip: vertices (n, 3), what they look up (n, 2), alpha (n,), triangles."""

    vertices: np.ndarray
    places: np.ndarray
    alpha: np.ndarray
    triangles: np.ndarray


def tiles(field: HeightField) -> list[Tile]:
    """Return the strip along all beaches of the field, in tiles."""
    distance, slope = shore_shape(field)
    side = round(field.size / CELL)
    at = (np.arange(side + 1) * CELL).astype(np.float64)
    scale = len(distance) / field.size
    coarse = np.minimum((at * scale).astype(int), len(distance) - 1)
    found = distance[np.ix_(coarse, coarse)]
    near = (found > -1.6 * LONGEST * (1 + UNEVEN)) & (found < LONGEST + 2 * CELL)
    row, column = np.nonzero(near)
    x, z = at[column], at[row]

    # The map's values are at the middles of texels.
    u, v = x / field.size - 0.5 / len(distance), z / field.size - 0.5 / len(distance)
    apart = lookup(distance, u, v)
    steep = lookup(slope, u, v)
    reach = reaches(np.where(steep > 0, steep, 10.0), x, z)
    place = -apart / reach
    # A cell more at either side: on a narrow beach one cell is as wide as the fading is.
    beyond = 1.5 * CELL / reach
    good = (place > FIRST - beyond) & (place < LAST + beyond) & (reach > SHORTEST)
    number = np.full(near.shape, -1, np.int64)
    number[row[good], column[good]] = np.arange(int(good.sum()))
    x, z, reach = x[good], z[good], reach[good]
    place = np.clip(place[good], FIRST + HALF_TEXEL, LAST - HALF_TEXEL)
    y = np.maximum(field.terrain_height(x, z), field.water_level) + ABOVE
    turn = turns(x, z, 0.0)
    looked_up = np.stack([(place - FIRST) / (LAST - FIRST), -turn / (2 * np.pi * len(WAVES))], 1)
    alpha = np.clip((reach - SHORTEST) / SHORTEST, 0.0, 1.0)
    corners = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], axis=2)
    whole = (corners >= 0).all(axis=2)
    cell_row, cell_column = np.nonzero(whole)
    quads = corners[whole]
    per = round(TILE / CELL)
    tile = cell_row // per * (side // per + 1) + cell_column // per
    vertices = np.stack([x, y, z], axis=1)
    out = []
    for each in np.unique(tile):
        used, where = np.unique(quads[tile == each], return_inverse=True)
        own = where.reshape(-1, 4)[:, [0, 1, 2, 0, 2, 3]]
        out.append(
            Tile(
                vertices[used].astype(np.float32),
                looked_up[used].astype(np.float32),
                alpha[used].astype(np.float32),
                np.ascontiguousarray(own, np.uint32),
            )
        )
    return out


def joined(parts: list[Tile]) -> Tile:
    """Return tiles as one, so that a pass is one call of glDrawElements."""
    counts = [len(each.vertices) for each in parts]
    firsts = np.cumsum([0, *counts[:-1]], dtype=np.uint32)
    return Tile(
        np.concatenate([each.vertices for each in parts]),
        np.concatenate([each.places for each in parts]),
        np.concatenate([each.alpha for each in parts]),
        np.concatenate([each.triangles + first for each, first in zip(parts, firsts, strict=True)]),
    )


def debris(foam: np.ndarray) -> np.ndarray:
    """Return foam (STEPS, ACROSS) and the weed above it as a texture, uint8 (STEPS, ACROSS, 4).

    The density of weed across the beach is the same at all times.
    """
    place = FIRST + (np.arange(ACROSS) + 0.5) / ACROSS * (LAST - FIRST)
    weed = 0.25 * np.exp(-np.square((place - WEED_AT) / 0.09))
    weedy = place > 0.5 * (1.0 + WEED_AT)
    colour = np.where(weedy[:, None], WEED, COLOUR)
    density = np.where(weedy, weed, foam)
    whole = np.empty((*foam.shape, 4))
    whole[..., :3] = colour
    whole[..., 3] = density
    return np.rint(np.clip(whole, 0.0, 1.0) * 255).astype(np.uint8)


def remembered_tiles(field: HeightField) -> list[Tile]:
    """Return :func:`tiles`, from the cache if they were made before."""

    def make() -> tuple[np.ndarray, ...]:
        made = tiles(field)
        counts = np.array([(len(each.vertices), len(each.triangles)) for each in made], np.int64)
        if not made:
            return (counts,)
        columns = [(each.vertices, each.places, each.alpha, each.triangles) for each in made]
        return counts, *(np.concatenate(column) for column in zip(*columns, strict=True))

    counts, *columns = recall(("run-up", *field.made_from), make)
    if not columns:
        return []
    ends = counts.reshape(-1, 2).cumsum(axis=0)[:-1]
    cuts = [ends[:, 0]] * 3 + [ends[:, 1]]
    parts = [np.split(column, cut) for column, cut in zip(columns, cuts, strict=True)]
    return [Tile(*each) for each in zip(*parts, strict=True)]


def remembered_pictures() -> tuple[np.ndarray, ...]:
    """Return the textures of what is wet, of debris and of lace, uint8 (n, m, 4) each."""

    def make() -> tuple[np.ndarray, ...]:
        found, threads = diagram(), lace(seed=1912)
        dark = 1.0 - (1.0 - DARKEST) * found.wet
        laced = picture(np.ones_like(threads), threads)
        return picture(dark, found.shine), debris(found.foam), laced

    return recall(["run-up's textures"], make)


def picture(colour: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """Return a texture, uint8 (n, m, 4), of grey colours and alpha of 0..1."""
    parts = np.stack([colour, colour, colour, alpha], axis=2)
    return np.rint(np.clip(parts, 0.0, 1.0) * 255).astype(np.uint8)


class RunUp:
    """The strip along all beaches; Sea draws it over ground and water."""

    def __init__(self, field: HeightField) -> None:
        """Make the textures and the strip."""
        self._tiles = remembered_tiles(field)
        lowest = np.array([each.vertices.min(axis=0) for each in self._tiles]).reshape(-1, 3)
        highest = np.array([each.vertices.max(axis=0) for each in self._tiles]).reshape(-1, 3)
        self._middles, self._halves = 0.5 * (lowest + highest), 0.5 * (highest - lowest)
        self._joined: tuple[list[int], Tile] | None = None
        wet, foam_and_weed, threads = remembered_pictures()
        self._wet = Texture(wet, trilinear=False)
        self._debris = Texture(foam_and_weed, trilinear=False)
        self._lace = Texture(threads, trilinear=False)

    def near(self, frame: Frame) -> Tile | None:
        """Return the strip within FARTHEST of the eye and in view; none if there is no beach."""
        apart = np.hypot(*(self._middles[:, ::2] - frame.eye[[0, 2]]).T)
        close = apart < FARTHEST + TILE
        shown = np.flatnonzero(close & boxes_in_view(frame, self._middles, self._halves)).tolist()
        if not shown:
            return None
        if self._joined is None or self._joined[0] != shown:
            self._joined = shown, joined([self._tiles[k] for k in shown])
        return self._joined[1]

    def draw(self, frame: Frame, settings: Settings, mirror: Taken | None) -> None:
        """Draw the strip near the eye; ``mirror`` is the sea's mirror image."""
        strip = self.near(frame)
        if strip is None:
            return
        groups = gl.GL_TEXTURE_BIT | gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT
        with attrib(groups):
            gl.glDisable(gl.GL_LIGHTING)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDepthFunc(gl.GL_LEQUAL)
            gl.glEnable(gl.GL_BLEND)
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonOffset(-1.0, -2.0)
            moved = frame.kt / PERIOD / len(WAVES) % 1.0
            faded = strip.alpha * left(strip, frame)
            self._darken(strip, faded, moved)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            if mirror is not None:
                self._mirror(frame, strip, faded, moved, mirror)
            # Less density frays foam, and a little less frays it all away.
            self._frayed(strip, faded**0.4, moved, painted(settings.sun, FACING))

    def _darken(self, strip: Tile, faded: np.ndarray, moved: float) -> None:
        """Multiply what is drawn by how dark wet sand is, and by 1 where the strip has faded."""
        with attrib(gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT):
            gl.glDisable(gl.GL_FOG)
            gl.glBlendFunc(gl.GL_ZERO, gl.GL_SRC_COLOR)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._wet.bind()
            combine({"COMBINE_RGB": "INTERPOLATE", "SRC0_RGB": "TEXTURE", "SRC1_RGB": "CONSTANT"})
            combine({"SRC2_RGB": "PRIMARY_COLOR", "OPERAND2_RGB": "SRC_ALPHA"})
            gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, np.ones(4, np.float32))
            with moved_texture(moved):
                send(strip, white(faded), [strip.places])

    def _mirror(
        self,
        frame: Frame,
        strip: Tile,
        faded: np.ndarray,
        moved: float,
        mirror: Taken,
    ) -> None:
        """Blend the mirror image over wet sand: the lower the eye looks at it, the more."""
        with attrib(gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT), projected(mirror, 0):
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
            gl.glActiveTexture(gl.GL_TEXTURE1)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._wet.bind()
            combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PREVIOUS", "COMBINE_ALPHA": "MODULATE"})
            combine({"SRC0_ALPHA": "PREVIOUS", "SRC1_ALPHA": "TEXTURE"})
            with moved_texture(moved):
                alpha = faded * SHINE * fresnel(strip.vertices, frame.eye)
                send(strip, white(alpha), [strip.vertices, strip.places])
            gl.glActiveTexture(gl.GL_TEXTURE0)

    def _frayed(self, strip: Tile, faded: np.ndarray, moved: float, light: np.ndarray) -> None:
        """Blend foam and weed where their density and that of lace together are above one half."""
        colors = white(faded)
        colors[:, :3] = light

        with attrib(gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT):
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._debris.bind()
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)

            gl.glActiveTexture(gl.GL_TEXTURE1)
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._lace.bind()
            combine({"COMBINE_RGB": "REPLACE", "SRC0_RGB": "PREVIOUS"})
            combine({"COMBINE_ALPHA": "ADD_SIGNED", "SRC0_ALPHA": "PREVIOUS"})
            combine({"SRC1_ALPHA": "TEXTURE"})
            gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_ALPHA_SCALE, 4.0)

            gl.glMatrixMode(gl.GL_TEXTURE)
            with matrix():
                gl.glScalef(LACE_REPEAT, LACE_REPEAT, 1.0)
                gl.glActiveTexture(gl.GL_TEXTURE0)
                with moved_texture(moved):
                    send(strip, colors, [strip.places, strip.vertices[:, ::2]])
                gl.glActiveTexture(gl.GL_TEXTURE1)
                gl.glMatrixMode(gl.GL_TEXTURE)
            gl.glActiveTexture(gl.GL_TEXTURE0)
            gl.glMatrixMode(gl.GL_MODELVIEW)

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        for each in (self._wet, self._debris, self._lace):
            each.release()


@contextmanager
def moved_texture(moved: float) -> Iterator[None]:
    """Let the block's active unit look up the diagram ``moved`` of its height later."""
    gl.glMatrixMode(gl.GL_TEXTURE)
    with matrix():
        gl.glTranslatef(0.0, moved, 0.0)
        yield
    gl.glMatrixMode(gl.GL_MODELVIEW)


def left(tile: Tile, frame: Frame) -> np.ndarray:
    """Return how much of the strip is left at the distance of each vertex, 0..1, (n,)."""
    apart = np.hypot(*(tile.vertices[:, ::2] - frame.eye[[0, 2]]).T)
    return np.asarray(np.clip((FARTHEST - apart) / (FARTHEST - FADING), 0.0, 1.0), np.float32)


def fresnel(vertices: np.ndarray, eye: np.ndarray) -> np.ndarray:
    """Return how much a level film of water mirrors to the eye at vertices (n, 3), 0..1."""
    view = eye - vertices
    facing = np.clip(view[:, 1] / np.maximum(np.linalg.norm(view, axis=1), 1e-9), 0.0, 1.0)
    return np.asarray(0.02 + 0.98 * (1.0 - facing) ** 5, np.float32)


def white(alpha: np.ndarray) -> np.ndarray:
    """Return white of alpha (n,), float32 (n, 4)."""
    colors = np.ones((len(alpha), 4), np.float32)
    colors[:, 3] = alpha
    return colors


def send(tile: Tile, colors: np.ndarray, layers: list[np.ndarray]) -> None:
    """Draw a tile with colours (n, 4) and texture coordinates for each unit."""
    layers = [np.ascontiguousarray(each, np.float32) for each in layers]
    with client_arrays(tile.vertices, None, colors, layers):
        gl.glDrawElements(gl.GL_TRIANGLES, tile.triangles.size, gl.GL_UNSIGNED_INT, tile.triangles)
