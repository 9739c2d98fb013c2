"""A natural landscape in classic fixed-function OpenGL: the 2006 report brought back.

>>> import landscape
>>> image = landscape.render("fig35e", size=(1280, 720))
"""

from landscape.errors import InputError, NoOpenGLError
from landscape.render import Offscreen, render

__version__ = "0.2.0"
__all__ = ["InputError", "NoOpenGLError", "Offscreen", "render"]
