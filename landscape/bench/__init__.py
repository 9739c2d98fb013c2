"""Benchmarks: a frame, the grass, the walk as it moves."""
