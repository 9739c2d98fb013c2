"""What the preset `best` adds to the rabbit and the dragon."""
