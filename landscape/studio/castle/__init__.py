"""The studio's castle: masonry, gate, fire, stones and the sword."""
