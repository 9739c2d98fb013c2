"""Measuring the assets: what each picture and mesh must be to serve, with the figures.

Plain numpy functions first, one for each property; then the table of what is asked of which file.
Needs no dependency of the studio, so that it runs wherever the program does.
"""

import json
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from landscape.elements.atlas import CELLS, padded
from landscape.elements.sprites.atlas import HERBS
from landscape.errors import InputError
from landscape.files.assets import Assets
from landscape.files.images import mip_chain, open_image, read_heights, read_image
from landscape.files.meshes import read_ply
from landscape.geometry.mesh import vertex_normals
from landscape.settings import preset

FACES = ("north", "east", "south", "west", "top")
SWORDS = ("sword_rest.png", "sword_1.png", "sword_2.png", "sword_3.png", "sword_4.png")
# File to width, height and mode: the contract between the studio and the scene.
SIZES = {
    "height.png": (512, 512, "RGB"),
    "height16.png": (512, 512, "I;16"),
    "ground_large.png": (2048, 2048, "RGB"),
    "ground_detail.png": (512, 512, "RGB"),
    "ground_sand.png": (512, 512, "RGB"),
    "ground_rock.png": (1024, 1024, "RGB"),
    "map.png": (512, 512, "RGB"),
    **{f"sky_{face}.png": (2048, 512, "RGB") for face in FACES[:4]},
    "sky_top.png": (1024, 1024, "RGB"),
    **{f"sky_sunset_{face}.png": (1024, 256, "RGB") for face in FACES[:4]},
    "sky_sunset_top.png": (512, 512, "RGB"),
    "clouds.png": (512, 512, "RGBA"),
    "water.png": (512, 512, "RGB"),
    "fire.png": (512, 512, "RGBA"),
    "castle_brick.png": (512, 512, "RGB"),
    "castle_door.png": (1024, 1024, "RGBA"),
    "castle_light.png": (256, 256, "RGB"),
    "torch_stone.png": (256, 256, "RGB"),
    **{name: (512, 512, "RGBA") for name in CELLS},
    **{name: (256, 256, "RGBA") for name in HERBS},
    "blade.png": (64, 64, "RGB"),
    "animal.png": (256, 256, "RGB"),
    **{name: (512, 512, "RGBA") for name in SWORDS},
}
MESHES = {"rabbit.ply": 8171, "dragon.ply": 22998}  # the report's vertex counts
TILES = (
    "ground_detail.png", "ground_sand.png", "ground_rock.png", "clouds.png", "water.png",
    "castle_brick.png", "torch_stone.png", "animal.png",
)  # fmt: skip
MID_GREY = ("ground_detail.png", "ground_sand.png", "ground_rock.png")
SHEETS = {"fire.png": 4}  # sprite sheets: frames to a side
MAX_BYTES = 15_000_000
MIP = 4  # the level whose coverage is asked for
SUNSET_HORIZON = (0.84, 0.66, 0.54)  # chosen: the fog to use with the sunset sky

# What the named views rely on: x and z, then between which heights y must be. All chosen.
PLACES = {
    "main summit": (13.0, 10.0, 4.3, 5.2),
    "second summit": (18.3, 7.1, 3.0, 4.1),
    "castle hill": (27.0, 17.0, 2.28, 2.32),
    "castle hill, west edge": (25.6, 17.0, 2.26, 2.34),
    "meadow": (20.0, 24.0, 0.8, 1.4),
    "bay": (11.0, 29.0, 0.05, 0.12),
    "beach of the bay": (14.0, 27.0, 0.6, 0.95),
    "north-east islet": (33.9, 14.5, 0.85, 1.3),
    "east islet": (34.9, 19.0, 0.85, 1.3),
    "south-east islet": (33.4, 23.2, 0.85, 1.3),
    "southern islet": (19.0, 36.3, 0.85, 1.3),
    "strait before the islets": (32.4, 19.0, 0.05, 0.4),
    "southern strait": (19.0, 34.6, 0.05, 0.4),
}
BORDER = 1.5  # units along the edges of the map that are sea floor
BORDER_MAX = 0.4


@dataclass(frozen=True)
class Finding:
    """One measured property of one asset."""

    asset: str
    measure: str
    ok: bool
    figures: str
    values: dict[str, float] = field(default_factory=dict)

    def line(self) -> str:
        """Return it for the screen."""
        return f"{'ok  ' if self.ok else 'FAIL'} {self.asset:24} {self.measure:12} {self.figures}"


# ---- pictures ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Seam:
    """Differences in levels over a tile's seam, and the greatest between neighbours inside.

    ``change`` is the mean of the differences' size, ``step`` the size of their mean: a step from
    light to dark hides in the first where the tile is all grain, and shows in the second.
    """

    axis: str
    change: float
    change_inside: float
    step: float
    step_inside: float

    @property
    def ok(self) -> bool:
        """Whether the seam cannot be told from any other place."""
        return self.change <= self.change_inside and self.step <= self.step_inside


def seams(picture: np.ndarray) -> list[Seam]:
    """Measure the seams of a tile (h, w, 3 or 4): last column to first, last row to first."""
    found = []
    values = picture.astype(np.int16)
    if values.shape[2] == 4:
        # What is transparent has a colour, but shows none.
        values = (values[..., :3].astype(np.int32) * values[..., 3:] // 255).astype(np.int16)
    for axis, name in ((1, "columns"), (0, "rows")):
        along = np.moveaxis(values, axis, 0)
        differences = np.diff(along, axis=0, append=along[:1])
        change = np.abs(differences).mean(axis=(1, 2))
        step = np.abs(differences.mean(axis=1)).max(axis=1)
        figures = (change[-1], change[:-1].max(), step[-1], step[:-1].max())
        found.append(Seam(name, *map(float, figures)))
    return found


def stretched(line: np.ndarray, count: int) -> np.ndarray:
    """Resample a line of colours (n, 3) to ``count``, ends on ends, as a face's edge is drawn."""
    at, places = np.linspace(0, 1, count), np.linspace(0, 1, len(line))
    return np.stack([np.interp(at, places, channel) for channel in line.T.astype(float)], axis=-1)


def sky_edges(faces: dict[str, np.ndarray]) -> dict[str, float]:
    """Return the greatest difference, in levels, along each of the eight edges faces share."""
    walls = FACES[:4]
    found = {}
    for one, other in zip(walls, (*walls[1:], walls[0]), strict=True):
        right, left = faces[one][:, -1].astype(int), faces[other][:, 0].astype(int)
        found[f"{one}-{other}"] = float(np.abs(right - left).max())
    top = faces["top"]
    edges = {"north": top[0], "east": top[:, -1], "south": top[-1, ::-1], "west": top[::-1, 0]}
    for wall, edge in edges.items():
        row = faces[wall][0].astype(float)
        found[f"{wall}-top"] = float(np.abs(stretched(edge, len(row)) - row).max())
    return found


def unbled(rgba: np.ndarray) -> int:
    """Count the fully transparent texels whose colour is not the nearest other texel's.

    Where several are equally near, any of their colours will do. (h, w, 4) uint8.
    """
    height, width = rgba.shape[:2]
    empty = rgba[..., 3] == 0
    if empty.all() or not empty.any():
        return 0
    colour = rgba[..., :3].astype(np.int64) @ np.array([65536, 256, 1])
    # In each column, the nearest opaque texel above and the nearest below.
    far = 4 * (height + width)
    rows = np.arange(height)[:, None]
    above = np.maximum.accumulate(np.where(empty, -far, rows), axis=0)
    below = np.minimum.accumulate(np.where(empty, far, rows)[::-1], axis=0)[::-1]
    columns = np.arange(width)
    apart = ((columns[:, None] - columns[None, :]) ** 2).astype(np.float32)
    wrong = 0
    for row in np.flatnonzero(empty.any(axis=1)):
        holes = np.flatnonzero(empty[row])
        up, down = row - above[row], below[row] - row
        near = np.minimum(up, down).astype(np.float32) ** 2
        distance = apart[holes] + near
        nearest = distance.argmin(axis=1)
        sides = [
            (up <= down, colour[np.clip(above[row], 0, None), columns]),
            (down <= up, colour[np.clip(below[row], None, height - 1), columns]),
        ]
        own = colour[row, holes]
        fits = np.zeros(len(holes), bool)
        for counts, source in sides:
            fits |= counts[nearest] & (source[nearest] == own)
        # The few left over may have the colour of another one just as near.
        left = np.flatnonzero(~fits)
        ties = distance[left] == distance[left, nearest[left]][:, None]
        for counts, source in sides:
            same = ties & counts & (source == own[left][:, None])
            fits[left] |= same.any(axis=1)
        wrong += int((~fits).sum())
    return wrong


def coverage(rgba: np.ndarray) -> tuple[float, float]:
    """Return the part of a sprite with an alpha over one half at mip level 0 and at level MIP.

    The sprite is fitted into the atlas's cell and reduced as the program does both.
    """
    chain = mip_chain(padded(rgba), MIP + 1)
    first, last = (float((level[..., 3] > 127).mean()) for level in (chain[0], chain[MIP]))
    return first, last


def frames(sheet: np.ndarray, side: int) -> np.ndarray:
    """Cut a sheet (h, w, c) into its frames (side * side, h / side, w / side, c), row by row."""
    h, w, channels = sheet.shape
    cut = sheet.reshape(side, h // side, side, w // side, channels)
    return cut.transpose(0, 2, 1, 3, 4).reshape(side * side, h // side, w // side, channels)


def loop_steps(pictures: np.ndarray) -> np.ndarray:
    """Return the mean difference (n,) from each frame (n, h, w, 4) to the next, last to first."""
    shown = pictures[..., :3] * (pictures[..., 3:] / 255.0)
    return np.abs(np.roll(shown, -1, axis=0) - shown).mean(axis=(1, 2, 3))


# ---- heights and meshes -----------------------------------------------------------------------


def height_at(heights: np.ndarray, x: float, z: float, size: float) -> float:
    """Return the height at the cell of an image (n, n) over ``size`` x ``size`` units."""
    n = heights.shape[0]
    return float(heights[int(z / size * n), int(x / size * n)])


def open_edges(triangles: np.ndarray) -> int:
    """Count the edges that are not met once in each direction: 0 is watertight, evenly wound."""
    t = triangles.astype(np.int64)
    pairs = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    n = int(t.max()) + 1
    once, count = np.unique(pairs[:, 0] * n + pairs[:, 1], return_counts=True)
    back = (once % n) * n + once // n
    return int((count != 1).sum() + (~np.isin(back, once)).sum())


def volume(vertices: np.ndarray, triangles: np.ndarray) -> float:
    """Return the signed volume of a closed mesh: positive if its faces look outward."""
    a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def crossed_normals(vertices: np.ndarray, triangles: np.ndarray, normals: np.ndarray) -> float:
    """Return the part of the faces' corners whose normal looks away from its own face."""
    a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
    face = np.cross(b - a, c - a)
    agree = np.einsum("ikj,ij->ik", normals[triangles].astype(float), face)
    return float((agree <= 0).mean())


# ---- what is asked of which file --------------------------------------------------------------


def check_files(assets: Assets) -> Iterator[Finding]:
    """Ask that every asset is there, of its size and mode, and that all are small enough."""
    total = 0
    for name in (*SIZES, *MESHES):
        path = assets.path(name)
        total += path.stat().st_size
        if name in MESHES:
            continue
        image = open_image(path)
        mode = "RGB" if image.mode == "P" and SIZES[name][2] == "RGB" else image.mode
        asked = "{}x{} {}".format(*SIZES[name])
        two = all(side & (side - 1) == 0 for side in image.size)
        ok = (*image.size, mode) == SIZES[name] and two
        text = f"{image.width}x{image.height} {image.mode}" + ("" if ok else f", expected {asked}")
        yield Finding(name, "size", ok, text, {"width": image.width, "height": image.height})
    text = f"{total / 1e6:.2f} MB of {MAX_BYTES / 1e6:.0f}"
    yield Finding("all", "bytes", total < MAX_BYTES, text, {"bytes": total})


def check_tiles(assets: Assets) -> Iterator[Finding]:
    """Ask that tiles have no seam, and that details do not change the colour below them."""
    for name in TILES:
        found = seams(read_image(assets.path(name), SIZES[name][2]))
        text = "; ".join(
            f"{s.axis} differ by {s.change:.2f} (inside up to {s.change_inside:.2f}),"
            f" step {s.step:.2f} ({s.step_inside:.2f})"
            for s in found
        )
        values = {s.axis: s.change for s in found}
        yield Finding(name, "seam", all(s.ok for s in found), text, values)
    for name in MID_GREY:
        means = read_image(assets.path(name), "RGB").mean(axis=(0, 1))
        worst = float(np.abs(means - 127.5).max())
        text = "mean {:.2f} {:.2f} {:.2f} (127.5 +- 1)".format(*means)
        yield Finding(name, "mean", worst <= 1.0, text, {"off": worst})


def check_sky(assets: Assets) -> Iterator[Finding]:
    """Ask that faces agree along their edges, and that their feet have the fog's colour."""
    for prefix, horizon in (("sky_", preset("best").fog.color), ("sky_sunset_", SUNSET_HORIZON)):
        faces = {f: read_image(assets.path(f"{prefix}{f}.png"), "RGB") for f in FACES}
        edges = sky_edges(faces)
        text = "edges " + ", ".join(f"{name} {value:.1f}" for name, value in edges.items())
        ok = max(edges.values()) <= 2.0
        yield Finding(f"{prefix}*.png", "edges", ok, f"{text} (up to 2)", edges)
        feet = np.concatenate([faces[face][-1] for face in FACES[:4]])
        off = float(np.abs(feet - 255.0 * np.array(horizon)).max())
        text = f"off the fog's colour by {off:.1f} (up to 2)"
        yield Finding(f"{prefix}*.png", "horizon", off <= 2.0, text, {"off": off})


def check_sprites(assets: Assets) -> Iterator[Finding]:
    """Ask that colours are bled, coverage kept through the mip levels, and the fire loops."""
    for name, (_, _, mode) in SIZES.items():
        if mode != "RGBA":
            continue
        rgba = read_image(assets.path(name))
        wrong = sum(unbled(frame) for frame in frames(rgba, SHEETS.get(name, 1)))
        empty = int((rgba[..., 3] == 0).sum())
        text = f"{wrong} of {empty} clear texels not of the nearest colour"
        yield Finding(name, "bleeding", wrong == 0, text, {"wrong": wrong})
    for name in (*CELLS, *HERBS):
        first, last = coverage(read_image(assets.path(name)))
        change = last / max(first, 1e-9) - 1.0
        text = f"{first:.4f} at mip 0, {last:.4f} at mip {MIP}: {change:+.1%} (up to 5%)"
        yield Finding(name, "coverage", abs(change) <= 0.05, text, {"change": change})
    for name, side in SHEETS.items():
        steps = loop_steps(frames(read_image(assets.path(name)), side))
        text = f"last to first {steps[-1]:.2f}, others {steps[:-1].min():.2f}"
        text += f" to {steps[:-1].max():.2f}"
        ok = bool(steps[-1] <= steps[:-1].max())
        yield Finding(name, "loop", ok, text, {"closing": float(steps[-1])})


def check_heights(assets: Assets) -> Iterator[Finding]:
    """Ask that both height images agree, and that the named places are as the views want them."""
    ground = preset("best").ground
    fine = read_heights(assets.path("height16.png"))
    coarse = read_heights(assets.path("height.png"))
    off = float(np.abs(fine - coarse).max())
    text = f"off height16.png by {off:.2f} levels (up to half)"
    yield Finding("height.png", "agreement", off <= 0.505, text, {"off": off})
    y = fine / 256.0 * ground.scale_y
    for place, (x, z, low, high) in PLACES.items():
        value = height_at(y, x, z, ground.size)
        text = f"{place}: y {value:.2f} ({low:g} to {high:g})"
        yield Finding("height16.png", "place", low <= value <= high, text, {"y": value})
    rim = math.ceil(BORDER / ground.size * y.shape[0])
    border = float(max(side.max() for side in (y[:rim], y[-rim:], y[:, :rim], y[:, -rim:])))
    text = f"highest {border:.2f} (up to {BORDER_MAX:g})"
    yield Finding("height16.png", "border", border <= BORDER_MAX, text, {"y": border})


def check_meshes(assets: Assets) -> Iterator[Finding]:
    """Ask for the report's vertex counts, closed surfaces that look outward, calm normals."""
    for name, wanted in MESHES.items():
        vertices, triangles = read_ply(assets.path(name))
        used = len(np.unique(triangles))
        text = f"{len(vertices):,} vertices, {used:,} of them used, {len(triangles):,} faces"
        text += f" (expected {wanted:,} vertices)"
        ok = len(vertices) == used == wanted
        yield Finding(name, "count", ok, text, {"vertices": len(vertices)})
        gaps = open_edges(triangles)
        yield Finding(name, "watertight", gaps == 0, f"{gaps} edges open", {"open": gaps})
        inside = volume(vertices, triangles)
        text = f"volume {inside:+.3f} (outward is positive)"
        yield Finding(name, "winding", gaps == 0 and inside > 0, text, {"volume": inside})
        normals = vertex_normals(vertices, triangles)
        length = float(np.abs(np.linalg.norm(normals.astype(float), axis=1) - 1.0).max())
        crossed = crossed_normals(vertices, triangles, normals)
        text = f"length off 1 by {length:.1e}, {crossed:.2%} of corners look away (up to 0.5%)"
        values = {"length_off": length, "crossed": crossed}
        yield Finding(name, "normals", length < 1e-5 and crossed <= 0.005, text, values)
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        middle, reach = float(np.abs(low + high).max() / 2), float((high - low).max() / 2)
        text = f"middle off by {middle:.4f}, largest half side {reach:.4f} (1)"
        ok = middle < 1e-3 and abs(reach - 1.0) < 1e-3
        yield Finding(name, "centred", ok, text, {"middle": middle, "reach": reach})


CHECKS: tuple[Callable[[Assets], Iterator[Finding]], ...] = (
    check_files, check_tiles, check_sky, check_sprites, check_heights, check_meshes,
)  # fmt: skip


def check(folder: Path | None = None) -> Iterator[Finding]:
    """Measure every asset, ``folder``'s own before the shipped ones, and yield what was found.

    A file that is missing or cannot be read is a finding too, and ends its group of measures.
    """
    assets = Assets(folder)
    for group in CHECKS:
        try:
            yield from group(assets)
        except InputError as error:
            yield Finding("", "readable", False, " ".join(str(error).splitlines()))


def report(folder: Path | None, as_json: bool) -> int:
    """Print every finding, those that fail once more at the end; return 1 if any fails."""
    found = []
    for finding in check(folder):
        found.append(finding)
        if not as_json:
            print(finding.line(), flush=True)
    failed = [finding for finding in found if not finding.ok]
    if as_json:
        print(json.dumps([vars(finding) for finding in found], indent=1))
    elif failed:
        print(f"\n{len(failed)} of {len(found)} failed:")
        print("\n".join(finding.line() for finding in failed))
    else:
        print(f"\nall {len(found)} passed")
    return 1 if failed else 0
