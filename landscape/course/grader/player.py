"""Plays a solution that was recorded: the program that the sandbox runs in place of it.

Or what a student's program has called: an error of OpenGL that it has caught is one here, too.
"""

import contextlib

import glfw
from OpenGL import GL

from landscape.course.grader.recorded import playing


def main() -> None:
    """Open a window, and make the calls of each frame."""
    (take,) = playing
    glfw.init()
    window = glfw.create_window(*take.size, "", None, None)
    glfw.make_context_current(window)
    for frame in take.frames:
        for name, args in frame:
            with contextlib.suppress(GL.GLError):
                getattr(GL, name)(*args)
        glfw.swap_buffers(window)
        glfw.poll_events()


if __name__ == "__main__":
    main()
