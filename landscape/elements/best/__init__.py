"""Additions of the preset `best` to the elements of 2006: a folder for each of them."""
