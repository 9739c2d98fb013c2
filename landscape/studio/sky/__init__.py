"""The studio's skies."""
