"""What the commands print and draw of a frame: text, JSON, sheets, animations, pages."""
