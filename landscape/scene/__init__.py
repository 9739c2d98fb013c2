"""What island, hall and voxels share: scene, view, and pairs of pictures to compare."""
