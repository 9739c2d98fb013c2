"""Additions of the preset `best` to the overlay."""
