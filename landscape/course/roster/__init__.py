"""A class: submissions found in folders and zips, graded side by side, and written as tables."""
