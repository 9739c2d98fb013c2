"""What the preset `best` adds to the sky: clouds that move."""
