"""What the preset `best` adds to the ground."""
