"""The window: the walk, its keys, the help panel, recordings."""
