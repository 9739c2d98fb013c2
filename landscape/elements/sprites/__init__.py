"""What the preset `best` adds to trees, deer and plants."""
