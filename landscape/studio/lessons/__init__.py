"""What the studio makes for the lessons."""
