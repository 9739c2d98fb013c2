"""The island in voxels: a terrain of cubes, in regions, with the document's passes (section 2)."""
