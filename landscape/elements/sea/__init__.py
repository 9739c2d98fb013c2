"""What the preset `best` adds to the water: a grid about the eye, waves, foam, sun glitter."""
