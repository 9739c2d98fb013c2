"""OpenGL objects for drawing: display lists, meshes, cube maps, textures to draw into."""
