"""The fly-over as a program: its window, film, benchmark and gallery page."""

SIZE = (1024, 768)  # chosen: the size at which its speed is stated
