"""Making the assets: every studio module's table, written whole file by whole file."""

import io
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from PIL import Image

from landscape.assets import shipped
from landscape.errors import InputError
from landscape.output import Progress, write_whole

# The height field first: ground and map are made from it.
MODULES = (
    "terrain", "ground", "sky", "water", "fire", "masonry", "trees", "deer", "plants",
    "rabbit", "dragon", "sword",
)  # fmt: skip


def table() -> dict[str, Callable[[], Any]]:
    """Return every asset's file name and the function that makes it."""
    makers: dict[str, Callable[[], Any]] = {}
    for name in MODULES:
        makers |= import_module(f"landscape.studio.{name}").ASSETS
    return makers


def encoded(made: Any) -> bytes:
    """Encode what a studio function returned: pixels as PNG, (vertices, faces) as binary PLY."""
    if isinstance(made, tuple):
        vertices, faces = made
        mesh = trimesh.Trimesh(vertices, faces, process=False)
        data = mesh.export(file_type="ply", vertex_normal=False)
        assert isinstance(data, bytes)
        return data
    buffer = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(made)).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def build(names: list[str], folder: Path | None = None, quiet: bool = False) -> int:
    """Make the named assets, or all, into ``folder`` (by default where the shipped ones are).

    InputError for a name that is no asset, or a folder that cannot be written.
    """
    makers = table()
    wanted = names or list(makers)
    for name in wanted:
        if name not in makers:
            raise InputError(f"assets build {name}: expected some of {', '.join(makers)}")
    target = folder or shipped()
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"--assets {target}: cannot be made ({error.strerror})") from None
    with Progress(len(wanted), quiet) as progress:
        for name in wanted:
            write_whole(target / name, encoded(makers[name]()))
            progress.step(name)
            if not quiet and not progress.shown:
                print(target / name, flush=True)
    return 0
