"""The window: the walk, its keys, the help panel, recordings."""

from landscape.gl.display import import_glfw

# Which display there is must be known before any module here imports glfw.
import_glfw()
