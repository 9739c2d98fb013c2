"""The studio makes every asset from code; the demo never imports it.

Each module offers plain functions that return arrays (pictures as uint8 of shape (height, width,
3 or 4), meshes as vertices and faces) and a table ``ASSETS`` from file name to function.
:mod:`landscape.studio.build` writes them. Needs the extra ``studio``.
"""
