"""Meshes in other formats than PLY, read by trimesh in a process of its own.

A small file of such a format may ask for any amount of memory or time. The process has little of
either, so that its end is not the program's. No OpenGL here.
"""

import logging
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from framelens.base.errors import InputError
from framelens.base.input import amount
from framelens.base.isolated import Ended, isolated

MOST_VERTICES = MOST_TRIANGLES = 1_000_000  # chosen: Stanford's largest dragon has 871,414
MOST_MEGABYTES = 1024  # chosen: of memory
MOST_SECONDS = 15  # of processor time, chosen


class DamagedMesh(Exception):
    """A mesh that trimesh cannot read, or that is too large: one line."""


def read_by_trimesh(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Return vertices float32 (n, 3) and triangles int64 (m, 3).

    InputError for a damaged file, and for one that takes more than it may.
    """
    try:
        return isolated(
            read,
            str(path),
            MOST_VERTICES,
            MOST_TRIANGLES,
            seconds=4 * MOST_SECONDS,
            worked=MOST_SECONDS,
            megabytes=MOST_MEGABYTES,
        )
    except Ended as ended:
        if ended.status is not None and ended.status > 0:
            raise _damaged(path, ended.message or "no reason") from None
        allowed = f"{MOST_SECONDS} s and {amount(MOST_MEGABYTES << 20)}"
        raise InputError(
            "{path}: expected a mesh read in {allowed}", path=path, allowed=allowed
        ) from None
    except MemoryError:
        raise _damaged(path, f"it needs more than {MOST_MEGABYTES} MB of memory") from None
    except DamagedMesh as error:
        raise _damaged(path, str(error)) from None


def _damaged(path: Path, reason: str) -> InputError:
    return InputError("{path}: expected a whole mesh ({reason})", path=path, reason=reason[:100])


def read(path: str, most_vertices: int, most_triangles: int) -> tuple[np.ndarray, np.ndarray]:
    """Read a mesh by trimesh, in this process; DamagedMesh says what is wrong with it."""
    try:
        import trimesh

        logging.disable()
        warnings.simplefilter("ignore")
        # Materials would open other files.
        options: dict[str, object] = (
            {"skip_materials": True} if path.lower().endswith((".obj", ".glb")) else {}
        )
        mesh: Any = trimesh.load(path, force="mesh", process=False, **options)
        vertices = np.ascontiguousarray(mesh.vertices, np.float32)
        triangles = np.ascontiguousarray(mesh.faces, np.int64)
        if len(vertices) > most_vertices or len(triangles) > most_triangles:
            raise ValueError(f"more than {most_vertices} vertices or {most_triangles} triangles")
    except MemoryError:
        raise
    except Exception as error:
        # The parsers of trimesh raise any kind of exception: all of them mean a damaged file.
        lines = str(error).strip().splitlines() or [type(error).__name__]
        raise DamagedMesh(lines[0]) from None
    return vertices, triangles
