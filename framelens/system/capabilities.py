"""The rights that root has beyond other users in Linux, which a process gives up.

The kernel's own description is capabilities(7).
"""

import ctypes
import os
import struct
import sys

assert sys.platform == "linux"

VERSION = 0x20080522  # of the form of capget(2) and capset(2): two words of each set
# To read and write files whoever owns them, as Landlock (landlock.py) allows: Python and its
# packages may be another user's.
KEPT = 1 << 1 | 1 << 2  # CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH


def drop() -> None:
    """Give up all but KEPT, for good if the process starts no program; OSError if not possible."""
    libc = ctypes.CDLL(None, use_errno=True)
    header = struct.pack("=Ii", VERSION, 0)
    sets = ctypes.create_string_buffer(24)  # effective, permitted, inheritable; then their rest
    _check(libc.capget(header, sets))
    effective, permitted, *_ = struct.unpack("=6I", sets.raw)
    kept = struct.pack("=6I", effective & KEPT, permitted & KEPT, 0, 0, 0, 0)
    _check(libc.capset(header, kept))


def _check(result: int) -> None:
    if result:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))
