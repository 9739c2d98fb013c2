"""Who may use a context, and when one is destroyed whose owner is gone.

A context belongs to the thread that opened it. Python, however, may collect an owner that nobody
closed at any moment and in any thread: while another context draws, in the middle of a display
list, at exit. OpenGL calls are not possible there. So a dropped context is only put on a list; it
is destroyed in its own thread, when the next context is opened there or an open one is used.
Nothing is destroyed when the program ends, which frees everything anyway.
"""

import os
import threading
import weakref
from collections.abc import Iterator
from contextlib import contextmanager

from framelens.base.errors import InputError
from framelens.gl.context import Context, open_context

_one_at_a_time = threading.RLock()  # the seam's state (calls.py) is that of one thread
_dropped: list["OwnedContext"] = []


class OwnedContext:
    """A context that lives at most as long as its owner."""

    def __init__(self, owner: object, backend: str) -> None:
        """Open a context, current in this thread; raises NoOpenGLError."""
        with _one_at_a_time:
            _destroy_dropped()
            self._context: Context = open_context(backend)
        self._thread, self._process = threading.current_thread(), os.getpid()
        # Appending to a list is safe at any moment: it takes no lock and calls nothing.
        self._finalizer = weakref.finalize(owner, _dropped.append, self)
        self._finalizer.atexit = False

    @contextmanager
    def current(self) -> Iterator[None]:
        """Make the context current for the block, in which other threads wait for their turn.

        InputError in another thread (or forked process) than that of the context.
        """
        if not self.here:
            raise InputError("this Offscreen belongs to another thread: open one in each thread")
        with _one_at_a_time:
            _destroy_dropped()
            self._context.make_current()
            yield

    @property
    def here(self) -> bool:
        """Whether this is the context's own thread."""
        return self._process == os.getpid() and self._thread is threading.current_thread()

    @property
    def context(self) -> Context:
        """The context itself, to be used only where it is :meth:`current`."""
        return self._context

    def release(self) -> None:
        """Destroy the context, at once in its own thread, later elsewhere; may be called twice."""
        if self._finalizer.detach() is None:
            return
        if self.here:
            self._context.release()
        else:
            _dropped.append(self)


def _destroy_dropped() -> None:
    """Destroy the dropped contexts of this thread, and of threads that have ended."""
    for owned in _dropped.copy():
        # A forked process has its parent's contexts, but not the threads that draw in them.
        inherited = owned._process != os.getpid()
        if not inherited and (owned.here or not owned._thread.is_alive()):
            _dropped.remove(owned)
            owned._context.release()
