"""All of OpenGL's state: read, set, compared, and put into words."""
