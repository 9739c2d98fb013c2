"""Meshes in other formats than PLY, read by trimesh in a process of its own.

A small file of such a format may ask for any amount of memory or time. The process has little of
either, so that its end is not the program's. No OpenGL here.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from framelens.base.errors import InputError
from framelens.base.input import amount
from framelens.system import limits

MOST_VERTICES = MOST_TRIANGLES = 1_000_000  # chosen: Stanford's largest dragon has 871,414
MOST_MEGABYTES = 1024  # chosen: of memory
MOST_SECONDS = 15  # of processor time, chosen
MODULE = "landscape.files.mesh_process"


def read_by_trimesh(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Return vertices float32 (n, 3) and triangles int64 (m, 3).

    InputError for a damaged file, and for one that takes more than it may.
    """
    # One thread: each of the others would take memory, which is limited.
    paths = {"PYTHONPATH": os.pathsep.join(sys.path), "OPENBLAS_NUM_THREADS": "1"}
    numbers = (MOST_MEGABYTES, MOST_SECONDS, MOST_VERTICES, MOST_TRIANGLES)
    allowed = f"{path}: expected a mesh read in {MOST_SECONDS} s and {amount(MOST_MEGABYTES << 20)}"
    try:
        done = subprocess.run(
            [sys.executable, "-P", "-m", MODULE, str(path), *map(str, numbers)],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            env={**os.environ, **paths},
            timeout=4 * MOST_SECONDS,
        )
    except subprocess.TimeoutExpired:
        raise InputError(allowed) from None

    if limits.crash(done.returncode):  # ended by the system, for its time or its memory
        raise InputError(allowed)
    if done.returncode > 0:
        reason = (done.stderr.decode(errors="replace").strip().splitlines() or ["no reason"])[-1]
        raise InputError(f"{path}: expected a whole mesh ({reason[:100]})")
    head, _, data = done.stdout.partition(b"\n")
    split = 12 * int(head)
    vertices = np.frombuffer(data[:split], np.float32).reshape(-1, 3)
    return vertices, np.frombuffer(data[split:], np.int64).reshape(-1, 3)
