"""Additions of the preset `best` to the air: mist over the bay."""
