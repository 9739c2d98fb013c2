"""The Python package glfw, with its library for the display there is; import it from here only.

Raises NoOpenGLError on import if the package cannot be loaded.
"""

from framelens.gl.display import import_glfw

glfw = import_glfw()
