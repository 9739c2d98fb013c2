"""Notebooks: views, lessons and checks in cells, and a walk that is live there."""
