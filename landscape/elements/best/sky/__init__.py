"""Additions of the preset `best` to the sky: clouds that move."""
