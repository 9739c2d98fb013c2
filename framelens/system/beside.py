"""A thread that watches, waits or reads beside the others, and ends with its process."""

import threading
from collections.abc import Callable


def beside(function: Callable[..., object], *arguments: object) -> threading.Thread:
    """Call a function in a thread that does not keep its process alive; return the thread."""
    thread = threading.Thread(target=function, args=arguments, daemon=True)
    thread.start()
    return thread
