"""Meshes in other formats than PLY, read by trimesh in a process of its own.

A small file of such a format may ask for any amount of memory or time. The process has little of
either, so that its end is not the program's. No OpenGL here.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from landscape.errors import InputError
from landscape.files.input import amount

MOST_VERTICES = MOST_TRIANGLES = 1_000_000  # chosen: Stanford's largest dragon has 871,414
MOST_MEMORY = 1 << 30  # bytes of address space, chosen
MOST_SECONDS = 15  # of processor time, chosen

# What the process runs. It says on standard error what is wrong, and writes the number of vertices,
# then vertices and triangles, to standard output.
_READ = """
import logging, resource, sys, warnings
path, memory, seconds, most_vertices, most_triangles = sys.argv[1], *map(int, sys.argv[2:])
resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
try:
    import numpy as np
    import trimesh

    logging.disable()
    warnings.simplefilter("ignore")
    # Materials would open other files.
    options = {"skip_materials": True} if path.lower().endswith((".obj", ".glb")) else {}
    mesh = trimesh.load(path, force="mesh", process=False, **options)
    vertices = np.ascontiguousarray(mesh.vertices, np.float32)
    triangles = np.ascontiguousarray(mesh.faces, np.int64)
    if len(vertices) > most_vertices or len(triangles) > most_triangles:
        raise ValueError(f"more than {most_vertices} vertices or {most_triangles} triangles")
except MemoryError:
    sys.exit(f"it needs more than {memory >> 20} MB of memory")
except Exception as error:
    # The parsers of trimesh raise any kind of exception: all of them mean a damaged file.
    sys.exit((str(error).strip().splitlines() or [type(error).__name__])[0])
sys.stdout.buffer.write(b"%d\\n" % len(vertices) + vertices.tobytes() + triangles.tobytes())
"""


def read_by_trimesh(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Return vertices float32 (n, 3) and triangles int64 (m, 3).

    InputError for a damaged file, and for one that takes more than it may.
    """
    # One thread: each of the others would take address space, which is what is limited.
    paths = {"PYTHONPATH": os.pathsep.join(sys.path), "OPENBLAS_NUM_THREADS": "1"}
    limits = (MOST_MEMORY, MOST_SECONDS, MOST_VERTICES, MOST_TRIANGLES)
    allowed = f"{path}: expected a mesh read in {MOST_SECONDS} s and {amount(MOST_MEMORY)}"
    try:
        done = subprocess.run(
            [sys.executable, "-c", _READ, str(path), *map(str, limits)],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            env={**os.environ, **paths},
            timeout=4 * MOST_SECONDS,
        )
    except subprocess.TimeoutExpired:
        raise InputError(allowed) from None
    if done.returncode < 0:  # ended by the system, for its time or its memory
        raise InputError(allowed)
    if done.returncode > 0:
        reason = (done.stderr.decode(errors="replace").strip().splitlines() or ["no reason"])[-1]
        raise InputError(f"{path}: expected a whole mesh ({reason[:100]})")
    head, _, numbers = done.stdout.partition(b"\n")
    split = 12 * int(head)
    vertices = np.frombuffer(numbers[:split], np.float32).reshape(-1, 3)
    return vertices, np.frombuffer(numbers[split:], np.int64).reshape(-1, 3)
