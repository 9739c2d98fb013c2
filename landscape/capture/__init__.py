"""Frames taken apart: recorded whole, made again call by call, edited, and asked for a pixel."""
