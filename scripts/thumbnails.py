"""Draw the small pictures of the title: the main views of each scene, and a flight.

    python scripts/thumbnails.py [NAME...]

writes them into landscape/walk/thumbnails, from renders of four times as many pixels.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

import landscape
from landscape.scene.scene import SCENES, scene
from landscape.walk.thumbnails import FLIGHT, FOLDER, SIZE

QUALITY = 80  # of the JPEG, chosen


def names() -> list[str]:
    """Return the names of all pictures."""
    return [*SCENES, *(name for each in SCENES for name in scene(each).main), FLIGHT]


def drawn(name: str) -> Image.Image:
    """Return the large picture of a view, or of the flight."""
    size = 2 * SIZE[0], 2 * SIZE[1]
    if name != FLIGHT:
        return landscape.render(scene(name).start if name in SCENES else name, size=size)
    with tempfile.TemporaryDirectory() as folder:
        words = [sys.executable, "-m", "landscape", "flyover", "canyon", "--frames", "1", "-q"]
        words += ["--size", f"{size[0]}x{size[1]}", "--at", "6", "--set", "flyover.mode=filled"]
        subprocess.run([*words, "--out", folder], check=True)
        (path,) = Path(folder).iterdir()
        with Image.open(path) as picture:
            return picture.convert("RGB")


def main() -> None:
    """Draw what the command line names, or all."""
    for name in sys.argv[1:] or names():
        small = drawn(name).convert("RGB").resize(SIZE, Image.Resampling.LANCZOS)
        small.save(FOLDER / f"{name}.jpg", quality=QUALITY, optimize=True)
        print(name)


if __name__ == "__main__":
    main()
