"""The floors: every module imports only from its own room or from one on a floor below it."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

# From the ground up. A name is a room or a module beside the rooms; rooms of one floor may not
# import each other.
FRAMELENS = (
    ("system",),
    ("base",),
    ("gl",),
    ("spec",),
    ("state",),
    ("tape",),
    ("program",),
    ("why",),
    ("report",),
    ("inspector",),
    ("commands",),
    ("__init__",),
    ("cli",),
    ("__main__",),
)
LANDSCAPE = (
    ("frame",),
    ("files", "settings"),
    ("elements.settings",),
    ("geometry",),
    ("flyover",),
    ("gl",),
    ("elements",),
    ("elements.best",),
    ("sound",),
    ("scene",),
    ("island", "hall", "voxel"),
    ("offscreen",),
    ("maker", "passes", "poster"),
    ("walk", "gallery", "studio"),
    ("bench", "film"),
    ("flyover.app",),
    ("course",),
    ("course.lessons", "course.exercises"),
    ("__init__",),
    ("commands",),
    ("notebook",),
    ("cli",),
    ("__main__",),
)
LEVELS = {
    f"{package}.{name}": (height, level)
    for height, (package, floors) in enumerate((("framelens", FRAMELENS), ("landscape", LANDSCAPE)))
    for level, floor in enumerate(floors)
    for name in floor
}

UNLISTED = (9, 0)  # above all floors: test_every_room_has_a_floor reports such a room


def modules(root: Path = ROOT) -> list[Path]:
    return sorted(
        path for name in ("framelens", "landscape") for path in (root / name).rglob("*.py")
    )


def room(module: str) -> str:
    """Return the room of a dotted name such as framelens.gl.seam; one beside the rooms is one."""
    parts = module.split(".")
    for length in (3, 2):
        name = ".".join(parts[:length])
        if name in LEVELS:
            return name
    return f"{parts[0]}.__init__" if parts[1:] in ([], ["__version__"]) else ".".join(parts[:2])


def own_name(path: Path, root: Path = ROOT) -> str:
    parts = path.relative_to(root).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" and len(parts) > 2 else parts)


@cache
def imports(path: Path) -> list[tuple[int, str]]:
    """Return the line and dotted name of each import of our packages, wherever it stands.

    What stands under `if TYPE_CHECKING` is not imported.
    """
    lines = []
    for node in statements(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        else:
            continue
        for name in names:
            if name.split(".")[0] in ("framelens", "landscape"):
                lines.append((node.lineno, name))
    return lines


def statements(block: ast.AST) -> Iterator[ast.stmt]:
    """Yield the statements in a block and in what it holds, but not those for types alone.

    An expression holds no import, and most of a program is expressions.
    """
    for field in ("body", "handlers", "cases", "orelse", "finalbody"):
        for node in getattr(block, field, ()):
            if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
                continue
            if isinstance(node, ast.stmt):
                yield node
            yield from statements(node)


def upward(path: Path, root: Path = ROOT) -> list[str]:
    """Return each import of a module that goes up, or across to another room of its floor."""
    mine = room(own_name(path, root))
    wrong = []
    for line, name in imports(path):
        other = room(name)
        if other == mine:
            continue
        if other not in LEVELS or LEVELS[other] >= LEVELS.get(mine, UNLISTED):
            wrong.append(f"{path.relative_to(root).as_posix()}:{line}: {name}")
    return wrong


def test_no_module_imports_from_a_floor_above() -> None:
    assert [each for path in modules() for each in upward(path)] == []


def test_every_room_has_a_floor() -> None:
    rooms = {room(own_name(path)) for path in modules()}
    assert rooms - set(LEVELS) == set(), "give these rooms a floor in LANDSCAPE or FRAMELENS above"
    assert set(LEVELS) - rooms == set(), "these rooms are gone: take them off their floors"


def test_an_import_that_goes_up_or_across_is_found(tmp_path: Path) -> None:
    for folder in ("framelens/gl", "landscape/gallery"):
        (tmp_path / folder).mkdir(parents=True)
    low = tmp_path / "framelens" / "gl" / "seam.py"
    high = tmp_path / "landscape" / "gallery" / "pairs.py"
    low.write_text("def late():\n    from landscape.elements.fog import enable\n")
    high.write_text("import landscape.walk.app\nfrom landscape.scene import scene\n")
    assert upward(low, tmp_path) == ["framelens/gl/seam.py:2: landscape.elements.fog.enable"]
    assert upward(high, tmp_path) == ["landscape/gallery/pairs.py:1: landscape.walk.app"]


def test_framelens_knows_nothing_of_the_island() -> None:
    for path in modules():
        if path.is_relative_to(ROOT / "framelens"):
            assert [name for _, name in imports(path) if name.startswith("landscape")] == [], path


def test_geometry_and_files_never_import_opengl() -> None:
    for path in modules():
        own = room(own_name(path))
        if own.startswith("landscape.") and LEVELS.get(own, UNLISTED) < LEVELS["landscape.gl"]:
            text = path.read_text(encoding="utf-8")
            assert "framelens.gl" not in text and "import OpenGL" not in text, path


def test_the_top_has_at_most_15_modules() -> None:
    assert len(list((ROOT / "landscape").glob("*.py"))) <= 15
