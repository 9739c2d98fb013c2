"""Beyond the water of 2006: a grid about the eye, waves, a rippling reflection, glitter, foam."""
