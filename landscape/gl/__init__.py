"""What drawing adds to framelens.gl: display lists, meshes, cube maps, textures to draw into."""
