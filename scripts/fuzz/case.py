"""What an input is, and what the folder that it runs in holds."""

import base64
import os
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from PIL import Image

from landscape.files.assets import shipped
from landscape.scene.scene import scene

ELEMENTS = scene().elements
# A small picture without much in it, drawn quickly.
RENDER = ["render", "--preset", "2006", "--size", "40x30", "--samples", "0"]
RENDER += ["--assets", "../assets", "--out", "out.png"]

# What an expression may use. For `damage`, PYTHONPATH must have this folder.
IMPORTS = (
    "import landscape, damage, numpy as np; from landscape.frame import Pose; "
    "from fractions import Fraction; from decimal import Decimal; from pathlib import Path; "
    "nan = float('nan'); inf = float('inf')"
)


@dataclass
class Case:
    """An input. ``files`` maps names to base64; ``special`` lists (kind, name, target).

    ``outputs`` names the files that it may change, ``pipes`` those that somebody must read;
    ``size`` is that of the picture it draws if it is accepted, None if any will do.
    """

    name: str = ""
    args: list[str] = field(default_factory=list)
    expression: str = ""
    files: dict[str, str] = field(default_factory=dict)
    special: list[tuple[str, str, str]] = field(default_factory=list)
    outputs: list[str] = field(default_factory=list)
    pipes: list[str] = field(default_factory=list)
    size: tuple[int, int] | None = None

    def as_json(self) -> dict[str, Any]:
        """Return the fields."""
        return asdict(self)

    def add(self, name: str, data: bytes) -> None:
        """Put a file into the case's folder."""
        self.files[name] = base64.b64encode(data).decode()

    def prepare(self, folder: Path) -> None:
        """Make the folder as the case is to find it."""
        folder.mkdir()
        for name, data in self.files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(base64.b64decode(data))
        for kind, name, target in self.special:
            path = folder / name
            match kind:
                case "folder":
                    path.mkdir()
                case "pipe":
                    os.mkfifo(path)
                case "link":
                    path.symlink_to(target)
                case "mode":
                    path.chmod(int(target, 8))


def write_shared(root: Path) -> None:
    """Write what many inputs use: ``assets``, whose pictures are small and quick to load."""
    folder = root / "assets"
    if not folder.exists():
        folder.mkdir()
        for path in shipped().glob("*.png"):
            with Image.open(path) as image:
                image.resize((min(image.width, 64), min(image.height, 64))).save(folder / path.name)
