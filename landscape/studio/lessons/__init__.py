"""Makers of the lessons' assets."""
