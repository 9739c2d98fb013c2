"""Plain geometry on arrays: cameras, meshes, height fields, obstacles. No OpenGL."""
