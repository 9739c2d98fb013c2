"""What the preset best adds to the grass: see :class:`meadow.Meadow`.

The technique of 2006 is in ``elements/grass.py``.
"""
