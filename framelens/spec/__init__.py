"""OpenGL 1.5 as tables: functions, their arguments, enumerants, and how values are written."""
