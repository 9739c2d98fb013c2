"""Additions of the preset `best` to the grass: see :class:`meadow.Meadow`.

The technique of 2006 is in ``elements/grass.py``.
"""
