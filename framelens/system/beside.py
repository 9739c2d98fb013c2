"""Threads: one that watches, waits or reads beside the others, and some that share work."""

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from concurrent.futures import ThreadPoolExecutor


def beside(function: Callable[..., object], *arguments: object) -> threading.Thread:
    """Call a function in a thread that ends with its process at the latest; return the thread."""
    thread = threading.Thread(target=function, args=arguments, daemon=True)
    thread.start()
    return thread


def threads(count: int) -> "ThreadPoolExecutor":
    """Return an executor of threads, for work in which each lets the others run much of the time.

    Python waits for its tasks before it ends.
    """
    from concurrent.futures import ThreadPoolExecutor  # most who watch need none

    return ThreadPoolExecutor(count)
