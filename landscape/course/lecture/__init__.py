"""The lecture: its file, its plates, and the window that shows it."""
