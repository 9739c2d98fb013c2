"""`landscape assets`: images and meshes. Its actions have modules of their own."""

EXAMPLE = "fetch-stanford"
