"""Six exhibits in the alcoves, from "Programming with OpenGL: Advanced Rendering" (SIGGRAPH 1997).

Each file shows one technique on a small model. cabinet.py holds them; niche.py is their stone.
"""
