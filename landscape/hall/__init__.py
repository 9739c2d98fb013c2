"""The castle's great hall: classic effects of fixed-function OpenGL, each with its safeguards."""
