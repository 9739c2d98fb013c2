"""The studio's animals: rabbit, deer and dragon."""
