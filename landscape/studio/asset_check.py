"""`landscape assets check`: the requirements on every image and mesh, and a report.

The measures themselves are in :mod:`landscape.studio.asset_measures`. Neither module depends on the
extra ``studio``, so the check runs wherever the program does.
"""

import json
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from framelens.base.errors import InputError
from landscape.elements.atlas import CELLS
from landscape.elements.best.animals.skinned import read_skinned
from landscape.elements.best.sprites.individuals import FIRST
from landscape.elements.best.stones.shapes import read_shapes
from landscape.elements.places_file import read_places
from landscape.elements.planting import KINDS
from landscape.elements.settings import TIMES, Settings, preset
from landscape.elements.sprite_names import HERBS, MORE_FILES
from landscape.files.assets import Assets
from landscape.files.images import open_image, read_heights, read_image
from landscape.files.meshes import read_ply, read_textured
from landscape.files.smooth import read_smooth
from landscape.flyover.environment import open_environment
from landscape.geometry.height_field import height_field
from landscape.geometry.mesh import vertex_normals
from landscape.studio.asset_measures import (
    MIP,
    SKY_FACES,
    count_unbled,
    coverage,
    flipped_normals,
    frames,
    height_at,
    largest_step,
    loop_steps,
    open_edges,
    seams,
    sky_edges,
    volume,
)
from landscape.voxel.blocks import PLANT_TILES
from landscape.voxel.blocks import TILES as BLOCK_TILES
from landscape.voxel.tiles import FILE as TILES_FILE
from landscape.voxel.tiles import PLANTS_FILE, RIPPLES_FILE, RIPPLES_SIDE, SIDE, tiles

SWORDS = ("sword_rest.png", "sword_1.png", "sword_2.png", "sword_3.png", "sword_4.png")
# Width, height and mode by file name: the contract between the studio and the scene.
SMALL_TREES = ("oak_young.png", "birch_young.png", "spruce_young.png", "bramble.png")
SIZES = {
    "height.png": (512, 512, "RGB"),
    "height16.png": (512, 512, "I;16"),
    "ground_large.png": (2048, 2048, "RGB"),
    "ground_detail.png": (512, 512, "RGB"),
    "ground_sand.png": (512, 512, "RGB"),
    "ground_rock.png": (1024, 1024, "RGB"),
    "map.png": (512, 512, "RGB"),
    **{f"sky_{face}.png": (2048, 512, "RGB") for face in SKY_FACES[:4]},
    "sky_top.png": (1024, 1024, "RGB"),
    **{f"sky_sunset_{face}.png": (1024, 256, "RGB") for face in SKY_FACES[:4]},
    "sky_sunset_top.png": (512, 512, "RGB"),
    **{
        f"sky_{name}_{face}.jpg": (2048, 512, "RGB")
        for name in ("fair", "dusk")
        for face in SKY_FACES[:4]
    },
    **{f"sky_{name}_top.jpg": (1024, 1024, "RGB") for name in ("fair", "dusk")},
    "sky_unfolded.jpg": (1024, 1024, "RGB"),
    "clouds.png": (512, 512, "RGBA"),
    "water.png": (512, 512, "RGB"),
    "fire.png": (512, 512, "RGBA"),
    "caustics.png": (1024, 512, "L"),
    "mosaic.png": (256, 256, "RGB"),
    "castle_brick.png": (512, 512, "RGB"),
    "castle_ashlar.png": (512, 512, "RGB"),
    "castle_slate.png": (256, 256, "RGB"),
    "castle_leaves.png": (256, 256, "RGBA"),
    "castle_ivy.png": (512, 256, "RGBA"),
    "castle_door.png": (1024, 1024, "RGBA"),
    "castle_light.png": (256, 256, "RGB"),
    "torch_stone.png": (256, 256, "RGB"),
    **{name: (512, 512, "RGBA") for name in CELLS},
    **{name: (256, 256, "RGBA") for name in HERBS},
    **{name: (512, 512, "RGBA") for name in (*FIRST, *MORE_FILES)},
    **{name: (256, 256, "RGBA") for name in SMALL_TREES},
    "blade.png": (64, 64, "RGB"),
    "sward.png": (1024, 512, "RGBA"),
    "animal.png": (256, 256, "RGB"),
    **{name: (512, 512, "RGBA") for name in SWORDS},
    **{f"hall_{name}.png": (512, 512, "RGB") for name in ("wall", "vault", "stone", "medallion")},
    "hall_floor.png": (1024, 1024, "RGB"),
    **{f"hall_{name}.png": (256, 256, "RGB") for name in ("band", "wood")},
    "hall_light.png": (2048, 2048, "RGB"),
    "castle_hall.jpg": (2048, 1024, "RGB"),
    TILES_FILE: (SIDE, SIDE * len(BLOCK_TILES), "RGBA"),
    PLANTS_FILE: (SIDE * len(PLANT_TILES), SIDE, "RGBA"),
    RIPPLES_FILE: (RIPPLES_SIDE, RIPPLES_SIDE, "RGB"),
}
# Sprites of a palette, whose transparent texels all have one colour: the program bleeds them.
PALETTED = ("tree_birch.png", "tree_shrub.png", *FIRST, *MORE_FILES)
MOST_OFF = 12.0  # chosen, levels: how far that colour may be from the mean of the visible ones
# Strips, which the program cuts into tiles of this width and height before it makes textures.
STRIPS = {TILES_FILE: (SIDE, SIDE), PLANTS_FILE: (SIDE, SIDE)}
# Vertices; those of the animals are the report's.
STONES = "stones.ply"  # many shapes in a row
MESHES = {"rabbit.ply": 8171, "dragon.ply": 22998, STONES: 1349}
TEXTURED = {"castle_hall.ply": 9030}  # vertices of meshes that are neither closed nor lit
SKINNED = {"serpent.ply": 45_992}  # faces at most: as many as the dragon of 2006 has
TILES = (
    "ground_detail.png",
    "ground_sand.png",
    "ground_rock.png",
    "clouds.png",
    "water.png",
    "castle_brick.png",
    "castle_ashlar.png",
    "castle_slate.png",
    "torch_stone.png",
    "mosaic.png",
    "animal.png",
    "hall_wall.png",
    "hall_vault.png",
    "hall_stone.png",
    "hall_floor.png",
    "hall_wood.png",
    RIPPLES_FILE,
)
MID_GREY = ("ground_detail.png", "ground_sand.png", "ground_rock.png")
# Pictures of the sky stored as JPEG. The eye sees a step along an edge, which is a difference of
# one sign over many texels. It does not see the noise of coding, whose sign changes from block to
# block.
RUN = 64  # texels, chosen: eight blocks, some three degrees of the sky
CODED_STEP = 3.0  # levels, chosen: the largest mean difference over such a run
CODED_MOST = 24.0  # levels, chosen: of a single texel, at the edge of a cloud
SHEETS = {"fire.png": 4}  # sprite sheets: frames per side
# Of the software fly-over: maps of 512 x 512 with a path that is 700 to 1500 pixels long.
ENVIRONMENTS = ("flyover_alps.svg", "flyover_canyon.svg")
PLACES_FILES = ("avenue.csv", "crossing.csv")  # of trees, deer and plants, all on land
MAX_BYTES = 24_000_000  # of all assets together

# Chosen: x, z and the limits of y of the places that the named views rely on.
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
    "strait west of the islets": (32.4, 19.0, 0.05, 0.4),
    "southern strait": (19.0, 34.6, 0.05, 0.4),
}
BORDER = 1.5  # width of the border of the map that must be sea floor, in units
BORDER_MAX = 0.4  # greatest height in the border


@dataclass(frozen=True)
class Finding:
    """One measured property of one asset, and whether it meets the requirement."""

    asset: str
    measure: str
    ok: bool
    figures: str
    values: dict[str, float] = field(default_factory=dict)

    def line(self) -> str:
        """Return one line of the report."""
        return f"{'ok  ' if self.ok else 'FAIL'} {self.asset:24} {self.measure:12} {self.figures}"


def check_files(assets: Assets) -> Iterator[Finding]:
    """Check that every asset exists with its size and mode, and the size of all together."""
    total = 0
    for name in (*SIZES, *MESHES, *TEXTURED, *SKINNED, *ENVIRONMENTS, *PLACES_FILES):
        path = assets.path(name)
        total += path.stat().st_size
        if name not in SIZES:
            continue
        image = open_image(path)
        mode = "RGB" if image.mode == "P" and SIZES[name][2] == "RGB" else image.mode
        asked = "{}x{} {}".format(*SIZES[name])
        two = all(side & (side - 1) == 0 for side in STRIPS.get(name, image.size))
        ok = (*image.size, mode) == SIZES[name] and two
        text = f"{image.width}x{image.height} {image.mode}" + ("" if ok else f", expected {asked}")
        yield Finding(name, "size", ok, text, {"width": image.width, "height": image.height})
    text = f"{total / 1e6:.2f} MB of {MAX_BYTES / 1e6:.0f}"
    yield Finding("all", "bytes", total < MAX_BYTES, text, {"bytes": total})


def check_tiles(assets: Assets) -> Iterator[Finding]:
    """Check that tiles have no visible seam and that ground details have a neutral mean."""
    for name in TILES:
        found = seams(read_image(assets.path(name), SIZES[name][2]))
        text = "; ".join(
            f"{s.axis}: difference {s.change:.2f} (limit {s.change_inside:.2f}),"
            f" step {s.step:.2f} (limit {s.step_inside:.2f})"
            for s in found
        )
        values = {s.axis: s.change for s in found}
        yield Finding(name, "seam", all(s.ok for s in found), text, values)

    for name, tile in tiles(assets).items():
        # The ends of grass and snow that hang over earth meet only beside each other.
        found = [s for s in seams(tile) if s.axis == "columns" or not name.endswith("_side")]
        text = ", ".join(f"{s.axis}: {s.change:.2f} (limit {s.change_inside:.2f})" for s in found)
        ok = all(s.ok for s in found)
        yield Finding(TILES_FILE, "seam", ok, f"{name}, {text}", {s.axis: s.change for s in found})

    for name in MID_GREY:
        means = read_image(assets.path(name), "RGB").mean(axis=(0, 1))
        worst = float(np.abs(means - 127.5).max())
        text = "mean {:.2f} {:.2f} {:.2f} (127.5 +- 1)".format(*means)
        yield Finding(name, "mean", worst <= 1.0, text, {"off": worst})


def check_sky(assets: Assets) -> Iterator[Finding]:
    """Check that sky faces match along their edges and have the fog colour at the horizon."""
    day, sunset = preset("best").fog.color, TIMES["sunset"]["fog.color"]
    for prefix, suffix, horizon in (
        ("sky_", "png", day),
        ("sky_sunset_", "png", sunset),
        ("sky_fair_", "jpg", day),
        ("sky_dusk_", "jpg", sunset),
    ):
        coded = suffix == "jpg"
        faces = {f: read_smooth(assets.path(f"{prefix}{f}.{suffix}")) for f in SKY_FACES}
        run, limit, over = (RUN, CODED_STEP, f" over {RUN} texels") if coded else (1, 2.0, "")
        edges = sky_edges(faces, run)
        text = "edges " + ", ".join(f"{name} {value:.1f}" for name, value in edges.items())
        text += f" (limit {limit:g}{over})"
        ok = max(edges.values()) <= limit
        if coded:
            most = max(sky_edges(faces).values())
            text += f", single texels {most:.0f} (limit {CODED_MOST:.0f})"
            ok = ok and most <= CODED_MOST

        yield Finding(f"{prefix}*.{suffix}", "edges", ok, text, edges)
        last_rows = np.stack(
            [faces[face][-1] - 255.0 * np.array(horizon) for face in SKY_FACES[:4]]
        )
        off = max(largest_step(row, run) for row in last_rows)
        text = f"differs from the fog colour by {off:.1f} levels (limit {limit:g}{over})"
        yield Finding(f"{prefix}*.{suffix}", "horizon", off <= limit, text, {"off": off})


def surround(rgba: np.ndarray) -> float:
    """Return by how many levels transparent texels differ at most from the mean visible colour."""
    hidden = rgba[..., 3] == 0
    mean = rgba[~hidden][:, :3].mean(axis=0) if (~hidden).any() else np.zeros(3)
    return float(np.abs(rgba[hidden][:, :3] - mean).max(initial=0.0))


def check_sprites(assets: Assets) -> Iterator[Finding]:
    """Check colour bleeding, alpha coverage across mip levels, and the loop of the fire."""
    for name, (_, _, mode) in SIZES.items():
        # The holes between leaves have a colour of their own, which shows from afar.
        if mode != "RGBA" or name == TILES_FILE:
            continue
        rgba = read_image(assets.path(name))
        if name in PALETTED:
            off = surround(rgba)
            text = f"transparent texels are {off:.1f} levels from the mean (limit {MOST_OFF:.0f})"
            yield Finding(name, "surround", off <= MOST_OFF, text, {"off": off})
            continue
        parts = list(frames(rgba, SHEETS.get(name, 1)))
        if name in STRIPS:
            parts = np.split(rgba, rgba.shape[1] // STRIPS[name][0], axis=1)
        wrong = sum(count_unbled(part) for part in parts)
        empty = int((rgba[..., 3] == 0).sum())
        text = f"{wrong} of {empty} transparent texels lack the colour of the nearest visible one"
        yield Finding(name, "bleeding", wrong == 0, text, {"wrong": wrong})

    for name in (*CELLS, *HERBS, *FIRST, *MORE_FILES):
        first, last = coverage(read_image(assets.path(name)))
        change = last / max(first, 1e-9) - 1.0
        text = f"{first:.4f} at mip 0, {last:.4f} at mip {MIP}: {change:+.1%} (limit 5%)"
        yield Finding(name, "coverage", abs(change) <= 0.05, text, {"change": change})

    for name, side in SHEETS.items():
        steps = loop_steps(frames(read_image(assets.path(name)), side))
        text = f"difference last to first frame {steps[-1]:.2f},"
        text += f" others {steps[:-1].min():.2f} to {steps[:-1].max():.2f}"
        ok = bool(steps[-1] <= steps[:-1].max())
        yield Finding(name, "loop", ok, text, {"closing": float(steps[-1])})


def check_heights(assets: Assets) -> Iterator[Finding]:
    """Check that both height images agree and that the named places have the expected heights."""
    ground = preset("best").ground
    fine = read_heights(assets.path("height16.png"))
    coarse = read_heights(assets.path("height.png"))
    off = float(np.abs(fine - coarse).max())
    text = f"differs from height16.png by {off:.2f} levels (limit 0.5)"
    yield Finding("height.png", "agreement", off <= 0.505, text, {"off": off})
    y = fine / 256.0 * ground.scale_y
    for place, (x, z, low, high) in PLACES.items():
        value = height_at(y, x, z, ground.size)
        text = f"{place}: y {value:.2f} ({low:g} to {high:g})"
        yield Finding("height16.png", "place", low <= value <= high, text, {"y": value})
    rim = math.ceil(BORDER / ground.size * y.shape[0])
    border = float(max(side.max() for side in (y[:rim], y[-rim:], y[:, :rim], y[:, -rim:])))
    text = f"maximum y {border:.2f} (limit {BORDER_MAX:g})"
    yield Finding("height16.png", "border", border <= BORDER_MAX, text, {"y": border})


def check_meshes(assets: Assets) -> Iterator[Finding]:
    """Check the vertex counts, closed outward-facing surfaces, and sound normals."""
    for name, wanted in MESHES.items():
        vertices, triangles = read_ply(assets.path(name))
        used = len(np.unique(triangles))
        text = f"{len(vertices):,} vertices, {used:,} of them used, {len(triangles):,} faces"
        text += f" (expected {wanted:,} vertices)"
        ok = len(vertices) == used == wanted
        yield Finding(name, "count", ok, text, {"vertices": len(vertices)})
        gaps = open_edges(triangles)
        yield Finding(name, "watertight", gaps == 0, f"{gaps} open edges", {"open": gaps})
        inside = volume(vertices, triangles)
        text = f"volume {inside:+.3f} (positive if faces point outward)"
        yield Finding(name, "winding", gaps == 0 and inside > 0, text, {"volume": inside})
        if name == STONES:
            levels = [len(shape) for shape in read_shapes(assets.path(name))]
            text = f"{len(levels)} shapes, {sum(levels)} with their coarser levels"
            yield Finding(name, "row", True, text, {"shapes": len(levels)})
            continue

        normals = vertex_normals(vertices, triangles)
        length = float(np.abs(np.linalg.norm(normals.astype(float), axis=1) - 1.0).max())
        crossed = flipped_normals(vertices, triangles, normals)
        text = f"length error {length:.1e}, {crossed:.2%} of corners flipped (limit 0.5%)"
        values = {"length_off": length, "crossed": crossed}
        yield Finding(name, "normals", length < 1e-5 and crossed <= 0.005, text, values)
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        middle, reach = float(np.abs(low + high).max() / 2), float((high - low).max() / 2)
        text = f"centre off by {middle:.4f}, largest half extent {reach:.4f} (expected 1)"
        ok = middle < 1e-3 and abs(reach - 1.0) < 1e-3
        yield Finding(name, "centred", ok, text, {"middle": middle, "reach": reach})


def check_textured(assets: Assets) -> Iterator[Finding]:
    """Check the vertex counts of textured meshes, and that they lie within their texture."""
    for name, wanted in TEXTURED.items():
        vertices, triangles, _, coordinates = read_textured(assets.path(name))
        used = len(np.unique(triangles))
        text = f"{len(vertices):,} vertices, {used:,} of them used (expected {wanted:,})"
        yield Finding(name, "count", len(vertices) == used == wanted, text, {"vertices": used})
        low, high = float(coordinates.min()), float(coordinates.max())
        text = f"texture coordinates from {low:.3f} to {high:.3f} (within 0 and 1)"
        yield Finding(name, "coordinates", low >= 0.0 and high <= 1.0, text, {"high": high})


def check_skinned(assets: Assets) -> Iterator[Finding]:
    """Check the number of faces of meshes that are cut into charts, and that the solid is whole."""
    for name, most in SKINNED.items():
        found = read_skinned(assets, name, name)
        if found is None:
            yield Finding(name, "skin", False, "expected colours and texture coordinates")
            continue
        count = len(found.flesh.triangles) + len(found.membranes.triangles)
        text = (
            f"{count:,} faces, {len(found.membranes.triangles):,} of membranes (at most {most:,})"
        )
        yield Finding(name, "count", count <= most, text, {"faces": count})
        text = "closed" if found.closed else "open edges besides those of its charts"
        yield Finding(name, "watertight", found.closed, text)
        inside = volume(found.flesh.vertices, found.flesh.triangles)
        text = f"volume {inside:+.3f} (positive if faces point outward)"
        yield Finding(name, "winding", inside > 0, text, {"volume": inside})


def check_environments(assets: Assets) -> Iterator[Finding]:
    """Check the size of each map, the length of its path, and that it uses the range of heights."""
    for name in ENVIRONMENTS:
        environment = open_environment(assets.path(name))
        length, range_ = environment.path.length, float(np.ptp(environment.image))
        ok = environment.side == 512 and 700 < length < 1500 and range_ > 200
        text = (
            f"{environment.side}x{environment.side}, path {length:.0f} pixels, "
            f"{len(environment.targets)} points to look at, {range_:.0f} of 255 greys"
        )
        yield Finding(name, "flight", ok, text, {"length": length, "range": range_})


def check_places(assets: Assets) -> Iterator[Finding]:
    """Check that the sprites of each file of places stand on the island's land."""
    settings = Settings()
    heights = read_heights(assets.path(settings.ground.height_image))
    land = height_field(heights, settings.ground, settings.water.level)
    for name in PLACES_FILES:
        found, *_ = read_places(assets.path(name), land, set(KINDS))
        above = float(found.positions[:, 1].min()) - settings.water.level
        text = f"{len(found.cells)} sprites, the lowest {above:.2f} units above the water"
        yield Finding(name, "places", above > 0.05, text, {"sprites": len(found.cells)})


CHECKS: tuple[Callable[[Assets], Iterator[Finding]], ...] = (
    check_files,
    check_tiles,
    check_sky,
    check_sprites,
    check_heights,
    check_meshes,
    check_textured,
    check_skinned,
    check_environments,
    check_places,
)


def check(folder: Path | None = None) -> Iterator[Finding]:
    """Check every asset, preferring files in ``folder`` to the shipped ones; yield the findings.

    A missing or unreadable file is a finding too, and ends its group of checks.
    """
    assets = Assets(folder)
    for group in CHECKS:
        try:
            yield from group(assets)
        except InputError as error:
            yield Finding("", "readable", False, " ".join(str(error).splitlines()))


def report(folder: Path | None, as_json: bool) -> int:
    """Print every finding and repeat the failed ones at the end; return 1 if any failed."""
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
