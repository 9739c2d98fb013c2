"""Additions of `best` to trees, deer and plants: see :class:`refined_sprites.RefinedSprites`.

The technique of 2006 is in ``elements/transparent_elements.py``.
"""
