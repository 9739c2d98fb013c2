"""The studio's textures for the voxel island."""
