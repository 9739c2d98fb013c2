"""The only rooms that import OpenGL: contexts, the seam all calls go through, and thin owners."""
