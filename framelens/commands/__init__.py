"""The commands that look into a frame: trace, pixel, state, strip, why, inspect."""
