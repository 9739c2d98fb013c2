"""Build the assets: run the makers from the studio modules' tables and write their files."""

import io
import os
from collections.abc import Callable, Generator
from concurrent.futures import Executor
from contextlib import closing
from importlib import import_module
from pathlib import Path
from typing import TypeAlias

import numpy as np
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from framelens.base.errors import InputError, reason
from framelens.base.executor import in_order, lent_or_own
from framelens.base.installation import how_to_add
from framelens.base.output import write_whole
from framelens.base.progress import Progress
from landscape.files.assets import shipped

# The height field comes first: the ground textures and the map are derived from it.
MODULES = (
    "land.terrain",
    "land.ground",
    "land.ground_details",
    "land.chart",
    "sky.sky",
    "sky.cloud_layer",
    "land.water",
    "castle.fire",
    "land.caustics",
    "hall.mosaic",
    "castle.masonry",
    "castle.ashlar",
    "castle.ivy",
    "castle.gate",
    "plants.trees",
    "plants.individuals",
    "animals.deer",
    "plants.plants",
    "plants.herbs",
    "plants.sward",
    "animals.rabbit",
    "animals.dragon",
    "animals.serpent",
    "castle.sword",
    "hall.stone",
    "hall.bake",
    "voxel.tiles",
    "voxel.plants",
    "voxel.ripples",
    "land.environments",
    "castle.stones",
    "castle.great_hall",
    "places",
)

INDIVIDUALS = (
    "oak_old",
    "oak_leaning",
    "oak_tall",
    "oak_young",
    "hazel",
    "birch_tall",
    "birch_twin",
    "birch_young",
    "spruce_old",
    "pine",
    "spruce_young",
    "thorn",
    "bramble",
    "stag",
    "stag_walking",
    "doe",
    "doe_grazing",
)

NEEDED = ("scipy", "numba", "scikit-image", "fast-simplification")  # the extra `studio`
PROCESSES = 2  # chosen: the smallest machine has two cores; each process needs half a gigabyte
# Number of palette colours for textures of nearly one hue. The loss is not visible, and the file
# is two thirds smaller.
PALETTES = {
    "ground_detail.png": 256,
    "ground_sand.png": 256,
    "ground_rock.png": 128,
    "castle_brick.png": 256,
    "castle_ashlar.png": 80,
    "castle_slate.png": 48,
    **dict.fromkeys(("hall_wall.png", "hall_vault.png", "hall_stone.png"), 128),
    **dict.fromkeys(("hall_floor.png", "hall_medallion.png"), 200),
    "mosaic.png": 64,
    **dict.fromkeys(("tree_birch.png", "tree_shrub.png"), 256),
    **dict.fromkeys((f"{name}.png" for name in INDIVIDUALS), 256),
}


# Of pictures stored as JPEG, whose names end with .jpg. Chosen: magnified three times, a sky looks
# the same as before coding once its gradients are smoothed (landscape/files/smooth.py).
QUALITY = 85
MADE_FROM = "Made from"  # keyword of the text in a PNG that says what it was made from


Asset: TypeAlias = np.ndarray | tuple[np.ndarray, ...] | str  # pixels; what ply() takes; text


def table() -> dict[str, Callable[[], Asset]]:
    """Return the function that makes each asset, by file name."""
    makers: dict[str, Callable[[], Asset]] = {}
    for name in MODULES:
        makers |= import_module(f"landscape.studio.{name}").ASSETS
    return makers


def ply(
    vertices: np.ndarray,
    faces: np.ndarray,
    colours: np.ndarray,
    coordinates: np.ndarray | None = None,
) -> bytes:
    """Encode vertices (n, 3), triangles (m, 3) and colours uint8 (n, 3) as a binary PLY.

    ``coordinates`` (n, 2), if any, are texture coordinates. Indices are 16-bit where the vertex
    count allows it.
    """
    kind, number = ("ushort", "<u2") if len(vertices) <= 65536 else ("uint", "<u4")
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
    header += [f"property float {axis}" for axis in "xyz"]
    header += [f"property uchar {name}" for name in ("red", "green", "blue")]
    fields: list[tuple[str, str, int]] = [("place", "<f4", 3), ("colour", "u1", 3)]
    if coordinates is not None:
        header += [f"property float {name}" for name in "st"]
        fields.append(("coordinates", "<f4", 2))
    header += [f"element face {len(faces)}", f"property list uchar {kind} vertex_indices"]
    points = np.empty(len(vertices), fields)
    points["place"], points["colour"] = vertices, colours
    if coordinates is not None:
        points["coordinates"] = coordinates
    rows = np.empty(len(faces), [("count", "u1"), ("corners", number, 3)])
    rows["count"], rows["corners"] = 3, faces
    text = "\n".join([*header, "end_header", ""]).encode()
    return text + points.tobytes() + rows.tobytes()


def texts() -> dict[str, Callable[[], str]]:
    """Return the function that says from what an asset is made, by file name, where one does."""
    found: dict[str, Callable[[], str]] = {}
    for name in MODULES:
        found |= getattr(import_module(f"landscape.studio.{name}"), "TEXTS", {})
    return found


def jpeg(pixels: np.ndarray) -> bytes:
    """Encode uint8 (h, w, 3) as JPEG, colours at full resolution."""
    buffer = io.BytesIO()
    image = Image.fromarray(np.ascontiguousarray(pixels))
    image.save(buffer, "JPEG", quality=QUALITY, subsampling=0, progressive=True, optimize=True)
    return buffer.getvalue()


def encoded(made: Asset, colours: int = 0, made_from: str = "") -> bytes:
    """Encode the result of a maker: pixels as PNG, (vertices, faces, colours) as PLY, text.

    If ``colours`` is not 0, the image is reduced to a palette of that size. ``made_from`` is
    written into the PNG, as the text of MADE_FROM.
    """
    if isinstance(made, tuple):
        return ply(*made)
    if isinstance(made, str):
        return made.encode()
    if colours and made.shape[2] == 4:
        # One colour for all transparent texels: a palette has no room for their neighbours'.
        visible = made[made[..., 3] > 0]
        mean = np.rint(visible[:, :3].mean(axis=0))
        made = np.where(made[..., 3:] > 0, made, np.append(mean, 0)).astype(np.uint8)

    image = Image.fromarray(np.ascontiguousarray(made))
    if colours:
        # Of the two, only the octree keeps an alpha channel.
        tree = image.mode == "RGBA"
        method = Image.Quantize.FASTOCTREE if tree else Image.Quantize.MEDIANCUT
        image = image.quantize(colours, method, dither=Image.Dither.NONE)

    buffer, info = io.BytesIO(), PngInfo()
    if made_from:
        info.add_text(MADE_FROM, made_from)
    image.save(buffer, "PNG", optimize=True, pnginfo=info)
    return buffer.getvalue()


def make(name: str) -> bytes:
    """Make one asset and return the bytes of its file."""
    made, made_from = table()[name](), texts().get(name, lambda: "")
    if name.endswith(".jpg"):
        assert isinstance(made, np.ndarray)
        return jpeg(made)
    return encoded(made, PALETTES.get(name, 0), made_from())


def make_all(
    names: list[str], executor: Executor | None = None, jobs: int = 0
) -> Generator[tuple[str, bytes], None, None]:
    """Make the assets side by side; yield the name and the bytes of each, in this order.

    The workers are ``jobs`` processes of this machine, up to PROCESSES by default, or those of an
    ``executor``.
    """
    count = min(jobs or min(PROCESSES, os.cpu_count() or 1), len(names))
    alone = count == 1 and executor is None
    with (
        lent_or_own(executor, count) as workers,
        closing(in_order(workers, make, names, ahead=1 if alone else len(names))) as files,
    ):
        yield from zip(names, files, strict=True)


def build(
    names: list[str],
    folder: Path | None = None,
    quiet: bool = False,
    executor: Executor | None = None,
    jobs: int = 0,
) -> int:
    """Build the named assets (all if none are named) into ``folder``; return the exit status.

    The default folder is that of the shipped assets; for ``executor`` and ``jobs`` see
    :func:`make_all`.
    Raises InputError for an unknown asset, a folder that cannot be created, or a missing extra.
    """
    try:
        makers = table()
    except ImportError as error:
        add = how_to_add(*NEEDED, extra="studio")
        raise InputError("assets build: {error}; run `{add}`", error=error, add=add) from None

    selected = list(dict.fromkeys(names)) or list(makers)
    for name in selected:
        if name not in makers:
            raise InputError(
                "assets build {name}: no such asset; choose from {names}",
                name=name,
                names=", ".join(makers),
            )
    target = folder or shipped()
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            "--assets {target}: cannot be created ({reason})", target=target, reason=reason(error)
        ) from None

    with (
        Progress(len(selected), quiet) as progress,
        closing(make_all(selected, executor, jobs)) as files,
    ):
        for name, data in files:
            write_whole(target / name, data)
            progress.step(name)
            if not quiet and not progress.shown:
                print(target / name, flush=True)

    return 0
