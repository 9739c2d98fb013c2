"""What the preset `best` adds to the elements of 2006: a folder for each of them."""
