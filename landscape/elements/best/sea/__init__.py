"""Beyond the water of 2006: a grid around the eye, waves, a rippling reflection, glitter, foam."""
