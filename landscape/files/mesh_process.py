"""The process in which trimesh reads a mesh, for other_meshes.py.

Its arguments are those of ``main``. It says on standard error what is wrong, or writes the number
of vertices, then vertices and triangles, to standard output.
"""

import logging
import sys
import warnings
from typing import Any

from framelens.system import limits


def main(path: str, megabytes: int, seconds: int, most_vertices: int, most_triangles: int) -> None:
    """Read a mesh within limits; SystemExit says what is wrong with it."""
    limits.limit_work(seconds)
    limits.limit_memory(megabytes << 20)
    try:
        import numpy as np
        import trimesh

        logging.disable()
        warnings.simplefilter("ignore")
        # Materials would open other files.
        options: dict[str, Any] = (
            {"skip_materials": True} if path.lower().endswith((".obj", ".glb")) else {}
        )
        mesh: Any = trimesh.load(path, force="mesh", process=False, **options)
        vertices = np.ascontiguousarray(mesh.vertices, np.float32)
        triangles = np.ascontiguousarray(mesh.faces, np.int64)
        if len(vertices) > most_vertices or len(triangles) > most_triangles:
            raise ValueError(f"more than {most_vertices} vertices or {most_triangles} triangles")
    except MemoryError:
        sys.exit(f"it needs more than {megabytes} MB of memory")
    except Exception as error:
        # The parsers of trimesh raise any kind of exception: all of them mean a damaged file.
        sys.exit((str(error).strip().splitlines() or [type(error).__name__])[0])
    output = sys.stdout.buffer
    output.write(b"%d\n" % len(vertices) + vertices.tobytes() + triangles.tobytes())


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
