"""Reading and writing files: assets, images, meshes, the cache, output. No OpenGL."""
