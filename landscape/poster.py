"""A poster: one huge still, drawn in tiles and written in strips, so that it needs little memory.

Each tile is drawn with the camera, the level of detail and the viewport of the whole picture, which
is moved so that the tile lies in the framebuffer: its pixels are those of the picture drawn whole.
Where no viewport is as large, the picture is cut into blocks, and the frustum with it. What is laid
over a picture, as the map, is left out.
"""

import pickle
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from framelens.base.executor import Kept, ahead, in_order, lent_or_own
from framelens.base.output import Output
from landscape.files.png_strips import PngStrips
from landscape.frame import LARGEST, Detail, Tile
from landscape.offscreen import Offscreen, Place, found
from landscape.scene.scene import SCENES, scene

TILE = 2048, 1024  # pixels, chosen: a strip of 16,384 pixels takes 50 MB
BLOCK = LARGEST  # pixels a side
MOST = 65536  # pixels a side, chosen


def draw(
    view: Place,
    size: tuple[int, int],
    out: Path,
    arguments: Mapping[str, Any],
    kt: float | None = None,
    wireframe: bool = False,
    tile: tuple[int, int] = TILE,
    done: Callable[[str], None] = lambda name: None,
    executor: Executor | None = None,
    jobs: int = 1,
) -> None:
    """Draw a view to a PNG of ``size`` in pixels; ``arguments`` are an Offscreen's, but its size.

    ``done`` is called after each tile. The workers are ``jobs`` processes of this machine, or those
    of an ``executor``. InputError where the view or the file is none.
    """
    given = _of_tiles(view, arguments, tile)
    packed = zlib.compress(pickle.dumps((view, size, given, kt, wireframe, dict(SCENES))))
    rows, columns = _pieces(size[1], tile[1]), _pieces(size[0], tile[0])
    corners = [(x, y) for y, _ in rows for x, _ in columns]

    output = Output(out, f"--out {out}")
    try:
        with (
            lent_or_own(executor, jobs) as workers,
            closing(in_order(workers, partial(draw_tile, packed), corners, ahead(jobs))) as tiles,
        ):
            png = PngStrips(output.write, size)
            for _, height in rows:
                png.add(_strip(tiles, (size[0], height), columns, done))
            png.finish()
        output.finish()
    finally:
        output.discard()
        _open.close()  # where the executor is one in this process


def _of_tiles(
    view: Place, arguments: Mapping[str, Any], tile: tuple[int, int]
) -> dict[str, object]:
    """Return an Offscreen's arguments for tiles, without what lies over a picture."""
    kind, named = found(view, scene(arguments.get("place", "")))
    shown = [name for name in kind.shown(named, arguments.get("only")) if name not in kind.overlay]
    return {**arguments, "size": tile, "only": shown}


def _pieces(side: int, piece: int) -> list[tuple[int, int]]:
    """Return where the pieces of a side begin, and how long each is."""
    return [(begin, min(piece, side - begin)) for begin in range(0, side, piece)]


def _strip(
    tiles: Iterator[np.ndarray],
    size: tuple[int, int],
    columns: Sequence[tuple[int, int]],
    done: Callable[[str], None],
) -> np.ndarray:
    """Return the next tiles side by side, uint8 (h, w, 3); the last may reach beyond the size."""
    width, height = size
    strip = np.empty((height, width, 3), np.uint8)
    for x, wide in columns:
        strip[:, x : x + wide] = next(tiles)[:height, :wide]
        done("tiles")
    return strip


def draw_tile(packed: bytes, corner: tuple[int, int]) -> np.ndarray:
    """Return the tile at x, y from the picture's upper left corner: a task for any executor.

    uint8 (h, w, 3) in the size of all tiles: at the right and below it may reach beyond the
    picture.
    """
    with _open.opened(packed, lambda: _Opened(packed)) as opened:
        return opened.tile(corner)


class _Opened:
    """The view, open with a target of the size of a tile."""

    def __init__(self, packed: bytes) -> None:
        view, self._size, arguments, kt, wireframe, scenes = pickle.loads(zlib.decompress(packed))
        SCENES.update(scenes)
        self._offscreen = Offscreen(**arguments)
        self._offscreen.look(view, kt, wireframe)

    def tile(self, corner: tuple[int, int]) -> np.ndarray:
        """Return a tile."""
        offscreen, (width, height) = self._offscreen, self._size
        # Blocks are cut from the upper left corner, as tiles are: none lies in two of them.
        left, across = _block(corner[0], width, offscreen.size[0])
        top, up = _block(corner[1], height, offscreen.size[1])
        # The mirror image is that of the block, and the same for all its tiles.
        detail = Detail(mirror=Detail().mirror * across / width)
        # OpenGL counts from the lower left corner.
        low = height - top - up
        tile = Tile(corner[0], height - corner[1] - offscreen.size[1], (left, low, across, up))
        moment = replace(offscreen.moment, size=self._size, tile=tile, detail=detail)
        opened = offscreen.scene
        assert opened is not None
        return offscreen.picture(lambda: offscreen.send(opened, moment))

    def close(self) -> None:
        """Release what is open."""
        self._offscreen.close()


def _block(at: int, whole: int, tile: int) -> tuple[int, int]:
    """Return where the block begins along a side in which something is, and how long it is."""
    if whole <= BLOCK:
        return 0, whole
    length = BLOCK // 2 // tile * tile
    begin = at // length * length
    return begin, min(length, whole - begin)


_open: Kept[_Opened] = Kept()
