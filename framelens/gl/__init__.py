"""The only modules that import OpenGL: contexts, the seam for all calls, and thin wrappers."""
