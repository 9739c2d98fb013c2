"""The fly-over as a program: its command, window, film, benchmark and gallery page."""
