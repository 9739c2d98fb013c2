"""What the preset `best` adds to what lies over the picture."""
