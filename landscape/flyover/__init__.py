"""The software fly-over: a terrain drawn without OpenGL, every pixel by arithmetic in numpy."""
