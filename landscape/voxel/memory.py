"""Memory that is free again goes back to the system: what a large world is built with is much.

The C library keeps what is freed, for what is asked for next. Between the steps of building that
would add up: the largest step would come on top of what the others have left unused.
"""

import ctypes
import functools
from collections.abc import Callable


@functools.lru_cache(maxsize=1)
def _trim() -> Callable[[int], int] | None:
    """Return glibc's malloc_trim; None where the C library is another."""
    try:
        found: Callable[[int], int] = ctypes.CDLL(None).malloc_trim
    except (OSError, AttributeError, TypeError):  # TypeError: Windows opens no library without name
        return None
    return found


def give_back() -> None:
    """Return free memory to the system, where the C library can."""
    trim = _trim()
    if trim is not None:
        trim(0)
