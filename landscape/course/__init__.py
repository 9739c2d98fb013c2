"""The course: its lessons in order, and the commands that show, run and copy them."""
