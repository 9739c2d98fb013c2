"""How much of the computer a student's program may take."""

SECONDS = 20.0  # chosen: a program's own work up to its last frame
MOST_SECONDS = 600.0  # chosen: what can be asked for
MEGABYTES = 1024  # chosen: beyond what Python and OpenGL take
