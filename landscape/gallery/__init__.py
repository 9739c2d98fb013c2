"""The gallery: the report's figures made again, and the fixes in pairs of pictures."""
