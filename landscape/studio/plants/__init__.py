"""The studio's plants: trees, herbs and grass."""
