"""The commands that look into a frame: a module each, with EXAMPLE, add_arguments and run."""
