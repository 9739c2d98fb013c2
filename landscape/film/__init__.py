"""Films: from a frame's number to its picture, drawn by several processes, and encoded."""
