"""Mesa's cache of compiled state, which a grader's programs read and only its own ones write.

Compiling takes most of a short program's time. What a program could write there, the next one would
execute. So programs of others get the cache as files that they can only read, beside one that is
thrown away with their folder. Its folder is that of the program's own cache (files/cache.py).
"""

import contextlib
import os
from pathlib import Path

from landscape.files import cache

NAME = "shaders"
# Mesa's name for its form of a single file, in folders of its own for each driver; and ours.
FILE, SHARED = "foz_cache", "shared"
ENDINGS = (".foz", "_idx.foz")


def folder() -> Path | None:
    """Return the cache's folder, which is made where it is missing; None where there is none."""
    place = cache.folder()
    if place is None:
        return None
    with contextlib.suppress(OSError):
        (place / NAME).mkdir(parents=True, exist_ok=True)
        return place / NAME
    return None


def use(shared: Path | None, own: Path, trusted: bool) -> list[Path]:
    """Let Mesa use the cache in this process, before OpenGL is opened; return where it writes.

    ``own`` is the folder of a program; the ``shared`` cache is written only if the program is
    ``trusted``, which ours are.
    """
    os.environ["MESA_DISK_CACHE_SINGLE_FILE"] = "1"
    if shared is not None and trusted:
        os.environ["MESA_SHADER_CACHE_DIR"] = str(shared)
        return [shared]
    os.environ["MESA_SHADER_CACHE_DIR"] = str(own)
    os.environ["MESA_DISK_CACHE_READ_ONLY_FOZ_DBS"] = SHARED
    if shared is None:
        return []
    for file in shared.glob(f"**/{FILE}.foz"):
        place = own / file.relative_to(shared).parent
        place.mkdir(parents=True)
        for ending in ENDINGS:
            (place / f"{SHARED}{ending}").symlink_to(file.with_name(f"{FILE}{ending}"))
    return []
