"""`landscape exercise`: the exercises for students. Its actions have modules of their own."""

EXAMPLE = "start winding"
