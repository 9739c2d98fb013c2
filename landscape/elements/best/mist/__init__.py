"""What the preset `best` can add to the air: mist over the bay."""
