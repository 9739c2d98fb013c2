"""The gallery: the report's figures drawn again, and the fixes in pairs of pictures."""
