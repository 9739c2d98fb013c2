"""The small pictures of views that the title shows; scripts/thumbnails.py draws them."""

from pathlib import Path

FOLDER = Path(__file__).parent
SIZE = (480, 270)  # pixels
FLIGHT = "flyover"  # the picture of the fly-over


def thumbnail(name: str) -> Path | None:
    """Return the file with the picture of a view, None if there is none."""
    path = FOLDER / f"{name}.jpg"
    return path if name.isidentifier() and path.is_file() else None
