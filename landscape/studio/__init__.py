"""The studio generates every asset from code; the demo never imports it.

The modules contain plain functions that return arrays: images as uint8 (height, width, 3 or 4),
meshes as vertices, faces and colours. A module that makes assets has a table ``ASSETS`` from file
name to function; :mod:`landscape.studio.build` writes the files. Requires the extra ``studio``.
"""
