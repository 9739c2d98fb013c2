"""The floors: every module imports only from its own floor or from one below it."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1] / "landscape"

# From the ground up. A name is a module or a room; rooms on one floor may not import each other,
# but for a room's own modules.
FLOORS = (
    ("errors", "frame"),
    ("system",),
    ("files",),
    ("keys", "languages"),
    ("arguments", "conditions", "settings"),
    ("geometry",),
    ("flyover",),
    ("gl",),
    ("capture",),
    ("why",),
    ("elements",),
    ("scene",),
    ("views",),
    ("fixes",),
    ("island", "effects", "voxel"),
    ("render",),
    ("window", "gallery", "studio"),
    ("tools",),
    ("film",),
    ("course",),
    ("lessons", "exercises"),
    ("__init__",),
    ("options",),
    ("cli",),
    ("__main__",),
)
LEVELS = {name: level for level, names in enumerate(FLOORS) for name in names}


def modules() -> list[Path]:
    return sorted(PACKAGE.rglob("*.py"))


def room(module: str) -> str:
    """Return the room of a dotted name such as landscape.gl.calls, or its own name at the top."""
    parts = module.split(".")[1:]
    return parts[0] if parts and parts[0] != "__version__" else "__init__"


def own_name(path: Path) -> str:
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" and len(parts) > 2 else parts)


def imports(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the line and dotted name of each import of this package, wherever it stands."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name.split(".")[0] == "landscape":
                    yield node.lineno, alias.name
        elif isinstance(node, ast.ImportFrom) and node.module:
            if node.module == "landscape":
                for alias in node.names:
                    yield node.lineno, f"landscape.{alias.name}"
            elif node.module.startswith("landscape."):
                yield node.lineno, node.module


def upward(path: Path) -> list[str]:
    """Return each import of a module that goes up, or across to another room of its floor."""
    mine = room(own_name(path))
    found = []
    for line, name in imports(path):
        other = room(name)
        if other == mine:
            continue
        if other not in LEVELS or LEVELS[other] >= LEVELS[mine]:
            found.append(f"{path.relative_to(PACKAGE.parent).as_posix()}:{line}: {name}")
    return found


@pytest.mark.parametrize("path", modules(), ids=lambda path: path.relative_to(PACKAGE).as_posix())
def test_no_module_imports_from_a_floor_above(path: Path) -> None:
    assert upward(path) == []


def test_every_room_has_a_floor() -> None:
    rooms = {room(own_name(path)) for path in modules()}
    assert rooms == set(LEVELS)


def test_an_import_that_goes_up_or_across_is_found(tmp_path: Path, monkeypatch) -> None:
    folder = tmp_path / "landscape"
    (folder / "gl").mkdir(parents=True)
    (folder / "gallery").mkdir()
    monkeypatch.setattr("test_rooms.PACKAGE", folder)
    low, high = folder / "gl" / "calls.py", folder / "gallery" / "pairs.py"
    low.write_text("def late():\n    from landscape.elements.fog import enable\n")
    high.write_text("import landscape.window.app\nfrom landscape import scene\n")
    assert upward(low) == ["landscape/gl/calls.py:2: landscape.elements.fog"]
    assert upward(high) == ["landscape/gallery/pairs.py:1: landscape.window.app"]


def test_geometry_and_files_never_import_opengl() -> None:
    for path in modules():
        below = LEVELS.get(room(own_name(path)), 99) < LEVELS["gl"]
        text = path.read_text(encoding="utf-8")
        if below:
            assert "landscape.gl" not in text and "import OpenGL" not in text, path


def test_the_top_has_at_most_15_modules() -> None:
    assert len(list(PACKAGE.glob("*.py"))) <= 15
