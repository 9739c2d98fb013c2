"""The studio's land: height images, ground, water."""
