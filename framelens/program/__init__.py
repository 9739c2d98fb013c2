"""Any PyOpenGL program, run unchanged up to a frame: source, clock, events, toolkit."""
