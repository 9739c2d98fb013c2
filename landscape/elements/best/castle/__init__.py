"""The castle of the preset `best`, and the one-pass gate of R11."""
