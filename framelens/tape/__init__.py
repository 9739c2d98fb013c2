"""A frame recorded whole: its calls, made again, edited, and asked for a pixel."""
