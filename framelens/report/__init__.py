"""Reports of a frame that the commands print and draw: text, JSON, sheets, animations, pages."""
