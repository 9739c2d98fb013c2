"""Buildings, trees and animals as arrays of block numbers: plain numpy, no OpenGL.

A model is a uint8 array indexed [x, z, y], as the world is; where it is 0, nothing is placed and
the world keeps what it has. Its anchor is the middle of its base, (x // 2, z // 2) of its shape:
``put`` in ``shapes.py`` places a model by it. What a model has below the ground is named there: the
castle's floor, for instance, is at level ``castle.FLOOR``.
"""
