"""The window on the screen: full screen and back, its title, and pictures of it as files."""

import numpy as np

from framelens.base.errors import InputError
from framelens.base.output import next_free, save_png
from framelens.gl.glfw_library import glfw


class FullScreen:
    """Takes a window to the full screen and back to its place and size."""

    def __init__(self, size: tuple[int, int]) -> None:
        """``size`` is the window's, in the window system's coordinates, where it began full."""
        self._windowed = (60, 60, *size)

    def toggle(self, window: object) -> bool:
        """Change over; return False where there is no monitor."""
        if glfw.get_window_monitor(window):
            glfw.set_window_monitor(window, None, *self._windowed, 0)
        elif monitor := glfw.get_primary_monitor():
            self._windowed = (*glfw.get_window_pos(window), *glfw.get_window_size(window))
            mode = glfw.get_video_mode(monitor)
            glfw.set_window_monitor(
                window, monitor, 0, 0, mode.size.width, mode.size.height, mode.refresh_rate
            )
        else:
            return False
        return True


def hide_cursor(window: object, hidden: bool) -> None:
    """Hide the cursor and keep it in the window, or show it."""
    mode = glfw.CURSOR_DISABLED if hidden else glfw.CURSOR_NORMAL
    glfw.set_input_mode(window, glfw.CURSOR, mode)


class FrameRate:
    """Shows the frames per second in a window's title."""

    def __init__(self, scene: str) -> None:
        """Begin to count now; ``scene`` is what the scene is called, and comes before the rate."""
        self._title = f"landscape, {scene}" if scene else "landscape"
        self._counted, self._since = 0, glfw.get_time()

    def count(self, window: object) -> None:
        """Count a frame; once a second, write the title."""
        self._counted += 1
        elapsed = glfw.get_time() - self._since
        if elapsed >= 1.0:
            glfw.set_window_title(window, f"{self._title}  {self._counted / elapsed:.0f} fps")
            self._counted, self._since = 0, glfw.get_time()


def save_screenshot(pixels: np.ndarray) -> str:
    """Save a picture under the next free name in the current folder; return the name.

    "" where that is impossible.
    """
    try:
        path = next_free("screenshot", ".png")
    except OSError:
        return ""
    try:
        save_png(pixels, path)
    except InputError:
        path.unlink(missing_ok=True)
        return ""
    return path.name
