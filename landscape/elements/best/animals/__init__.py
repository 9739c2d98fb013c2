"""Additions of the preset `best` to the rabbit and the dragon."""
