"""A lens on one frame of any PyOpenGL program: its calls, its state, its pixels, and why.

framelens pixel program.py 400,300
"""

__version__ = "0.2.0"
