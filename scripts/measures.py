"""Count what makes the code hard to hold in one's head, as docs/measures.md lists it.

    python scripts/measures.py                 # this checkout
    python scripts/measures.py --root DIR      # another one, an older commit for example
    python scripts/measures.py --rooms         # the size of each room, too
    python scripts/measures.py --places        # and where the things counted are

Sizes are in nodes of the syntax tree, which blank lines, line breaks and comments do not change. A
program that stands in a string is parsed and counted like any other code.

The lessons, the exercises, and the scaffold of a lecturer's exercise are programs of their own,
which repeat each other on purpose: the counts of repeats, names and processes leave them out. What
stands twice in exercises and the scaffold is counted by itself.
"""

import argparse
import ast
import json
import re
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

PACKAGES = ("framelens", "landscape")
PROGRAMS = ("lessons", "exercises", "scaffold")
LONG_FUNCTION = 20  # lines
HEAVY_FUNCTION = 300  # nodes
WIDE_ASSIGNMENT = 3  # targets
LEAST_REPEAT = 40  # nodes
LONGEST_REPEAT = 12  # statements

TARGETS = {
    "`Any`": 250,
    "`# fmt: skip`": 20,
    "functions of 20+ lines without a blank line": 60,
    "tuple assignments of 3+ targets": 60,
    "exact repeats of 40+ nodes": 700,
    "import cycles": 0,
    "names declared global": 4,
    "classes with an `apply` of their own": 12,
}
"""The measures that have met their targets, and these: a test sees to it that they stay so."""

STARTERS = {
    "subprocess.Popen": "Popen",
    "subprocess.run": "run",
    "os.fork": "fork",
    "ProcessPoolExecutor": "ProcessPoolExecutor",
    "futures.ProcessPoolExecutor": "ProcessPoolExecutor",
    "ThreadPoolExecutor": "ThreadPoolExecutor",
    "threading.Thread": "Thread",
    "os.execv": "exec",
    "os.execve": "exec",
}
"""Calls that start a process or a thread, and their kinds."""

IMPORT = """
import json, sys, time
before = set(sys.modules)
begin = time.perf_counter()
import {package}
milliseconds = 1000 * (time.perf_counter() - begin)
print(json.dumps([milliseconds, sorted(set(sys.modules) - before)]))
"""

Function = ast.FunctionDef | ast.AsyncFunctionDef


def files(root: Path, folders: Iterable[str]) -> list[Path]:
    """Return the Python files of folders of a checkout, in order."""
    return sorted(path for folder in folders for path in (root / folder).rglob("*.py"))


def without_programs(paths: Iterable[Path]) -> list[Path]:
    """Return the files that are not lessons, exercises or the scaffold."""
    return [path for path in paths if not {*PROGRAMS} & {*path.parts}]


@cache
def parsed(path: Path) -> ast.Module:
    """Return the syntax tree of a file."""
    return ast.parse(path.read_text("utf-8"))


def holding(paths: Iterable[Path], pattern: str) -> Iterator[Path]:
    """Yield the files whose text matches a pattern: no other needs to be parsed."""
    return (path for path in paths if re.search(pattern, path.read_text("utf-8"), re.MULTILINE))


def nodes_in(tree: ast.AST) -> int:
    """Return the number of nodes of a syntax tree."""
    return sum(1 for _ in ast.walk(tree))


def programs_in_strings(tree: ast.Module) -> Iterator[ast.Module]:
    """Yield the programs in strings: three lines or more that parse, and import or call."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            continue
        if node.value.count("\n") < 3:
            continue
        try:
            program = ast.parse(node.value)
        except (SyntaxError, ValueError):
            continue
        kinds = (ast.Import, ast.ImportFrom, ast.Call)
        if any(isinstance(inside, kinds) for inside in ast.walk(program)):
            yield program


@cache
def size(path: Path) -> int:
    """Return the nodes of a file, with those of the programs in its strings."""
    tree = parsed(path)
    return nodes_in(tree) + sum(map(nodes_in, programs_in_strings(tree)))


def rooms(root: Path) -> dict[str, int]:
    """Return the nodes of each room: package/room, largest first."""
    sizes: Counter[str] = Counter()
    for path in files(root, PACKAGES):
        package, *rest = path.relative_to(root).parts
        sizes[f"{package}/{rest[0]}/" if len(rest) > 1 else f"{package}/*.py"] += size(path)
    return dict(sizes.most_common())


def place(root: Path, path: Path, node: ast.AST) -> str:
    """Return file:line of a node."""
    return f"{path.relative_to(root)}:{getattr(node, 'lineno', 1)}"


def statements(function: Function) -> list[ast.stmt]:
    """Return the statements of a function, without its docstring."""
    first = function.body[0]
    documented = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    return function.body[1:] if documented else function.body


def has_blank_line(function: Function, lines: list[str]) -> bool:
    """Return whether a blank line parts the body; those inside strings do not count."""
    in_strings = {
        number
        for node in ast.walk(function)
        if isinstance(node, (ast.Constant, ast.JoinedStr))
        for number in range(node.lineno, (node.end_lineno or node.lineno) + 1)
        if (node.end_lineno or node.lineno) > node.lineno
    }
    body = statements(function)
    between = range(body[0].lineno, (body[-1].end_lineno or 0) + 1)
    return any(not lines[n - 1].strip() for n in between if n not in in_strings)


def functions(root: Path, paths: Iterable[Path]) -> dict[str, list[str]]:
    """Return the places of long functions, those of them without a blank line, and heavy ones."""
    places: dict[str, list[str]] = {"long": [], "without a blank line": [], "heavy": []}
    for path in paths:
        lines = path.read_text("utf-8").splitlines()
        for node in ast.walk(parsed(path)):
            if not isinstance(node, Function):
                continue
            here = place(root, path, node)
            if nodes_in(node) >= HEAVY_FUNCTION:
                places["heavy"].append(here)
            body = statements(node)
            if body and (body[-1].end_lineno or 0) - body[0].lineno + 1 >= LONG_FUNCTION:
                places["long"].append(here)
                if not has_blank_line(node, lines):
                    places["without a blank line"].append(here)
    return places


def uses_of_any(root: Path, paths: Iterable[Path]) -> list[str]:
    """Return where the type `Any` stands."""
    return [
        place(root, path, node)
        for path in holding(paths, r"\bAny\b")
        for node in ast.walk(parsed(path))
        if isinstance(node, ast.Name) and node.id == "Any"
    ]


def unformatted(root: Path, paths: Iterable[Path]) -> list[str]:
    """Return the lines that the formatter is told to leave as they are."""
    return [
        f"{path.relative_to(root)}:{number}"
        for path in paths
        for number, line in enumerate(path.read_text("utf-8").splitlines(), 1)
        if "# fmt: skip" in line or "# fmt: off" in line
    ]


def wide_assignments(root: Path, paths: Iterable[Path]) -> list[str]:
    """Return where a tuple is assigned to a tuple of three or more names."""
    some = r"^[^=\n]*,[^=\n]*,[^=\n]* = (.*,.*,|.*[\[({]$)"
    return [
        place(root, path, node)
        for path in holding(paths, some)
        for node in ast.walk(parsed(path))
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Tuple)
        for target in node.targets
        if isinstance(target, ast.Tuple) and len(target.elts) >= WIDE_ASSIGNMENT
    ]


def names_declared_global(root: Path, paths: Iterable[Path]) -> list[str]:
    """Return each name of a `global` statement, and where."""
    return [
        f"{place(root, path, node)} {name}"
        for path in holding(paths, r"^\s*global\s")
        for node in ast.walk(parsed(path))
        if isinstance(node, ast.Global)
        for name in node.names
    ]


def questions_of_type(root: Path, paths: Iterable[Path]) -> list[str]:
    """Return where code asks what kind of thing it has: isinstance, getattr, hasattr."""
    return [
        place(root, path, node)
        for path in paths
        for node in ast.walk(parsed(path))
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id in ("isinstance", "getattr", "hasattr")
    ]


def classes_with(method: str, root: Path, paths: Iterable[Path]) -> list[str]:
    """Return the classes that define a method of this name."""
    return [
        f"{place(root, path, node)} {node.name}"
        for path in paths
        for node in ast.walk(parsed(path))
        if isinstance(node, ast.ClassDef)
        and any(isinstance(inner, Function) and inner.name == method for inner in node.body)
    ]


def dotted(node: ast.expr) -> str:
    """Return `a.b.c` for such an expression; of others, what is left after the last dot."""
    if isinstance(node, ast.Attribute):
        return f"{dotted(node.value)}.{node.attr}"
    return node.id if isinstance(node, ast.Name) else ""


def process_starts(root: Path, paths: Iterable[Path]) -> dict[str, list[str]]:
    """Return by kind where a process or a thread is started."""
    kinds: dict[str, list[str]] = defaultdict(list)
    for path in paths:
        for node in ast.walk(parsed(path)):
            if not isinstance(node, ast.Call):
                continue
            name = dotted(node.func)
            kind = "Process" if name.endswith(".Process") else STARTERS.get(name)
            if kind:
                kinds[kind].append(place(root, path, node))
    return dict(kinds)


def borne_twice(names: Iterable[tuple[str, str]]) -> dict[str, list[str]]:
    """Return the names that occur at two or more places, from pairs (name, place)."""
    places: dict[str, list[str]] = defaultdict(list)
    for name, where in names:
        places[name].append(where)
    return {name: found for name, found in places.items() if len(found) > 1}


def modules_of_one_name(root: Path, paths: Iterable[Path]) -> dict[str, list[str]]:
    """Return the names that two or more modules bear."""
    packages = [(path.parent.name, path) for path in paths if path.name == "__init__.py"]
    modules = [(path.stem, path) for path in paths if not path.stem.startswith("__")]
    return borne_twice((name, str(path.relative_to(root))) for name, path in packages + modules)


def classes_of_one_name(root: Path, paths: Iterable[Path]) -> dict[str, list[str]]:
    """Return the names that two or more classes bear."""
    return borne_twice(
        (node.name, place(root, path, node))
        for path in paths
        for node in ast.walk(parsed(path))
        if isinstance(node, ast.ClassDef)
    )


def blocks(tree: ast.AST) -> Iterator[list[ast.stmt]]:
    """Yield the lists of statements of a tree, without a module's imports."""
    for node in ast.walk(tree):
        for field in ("body", "orelse", "finalbody"):
            block = getattr(node, field, None)
            if not isinstance(block, list) or not block or not isinstance(block[0], ast.stmt):
                continue
            if isinstance(node, ast.Module):
                block = [
                    each for each in block if not isinstance(each, ast.Import | ast.ImportFrom)
                ]
            yield block


def repeats(root: Path, paths: Iterable[Path]) -> list[tuple[int, list[str]]]:
    """Return the runs of statements that stand twice word for word: nodes too many, and places.

    Of runs that overlap, the largest counts.
    """
    sizes: dict[tuple[int, ...], int] = {}
    places: dict[tuple[int, ...], list[tuple[Path, int, int]]] = defaultdict(list)
    numbers: dict[str, int] = {}
    for path in paths:
        for block in blocks(parsed(path)):
            texts = [numbers.setdefault(ast.dump(statement), len(numbers)) for statement in block]
            counts = [nodes_in(statement) for statement in block]
            for first in range(len(block)):
                for after in range(first + 1, min(len(block), first + LONGEST_REPEAT) + 1):
                    nodes = sum(counts[first:after])
                    if nodes < LEAST_REPEAT:
                        continue
                    text = tuple(texts[first:after])
                    sizes[text] = nodes
                    last = block[after - 1]
                    places[text].append((path, block[first].lineno, last.end_lineno or last.lineno))

    taken: dict[Path, set[int]] = defaultdict(set)
    runs = []
    for text in sorted((text for text in places if len(places[text]) > 1), key=lambda t: -sizes[t]):
        free = [
            (path, first, last)
            for path, first, last in dict.fromkeys(places[text])
            if not taken[path] & {*range(first, last + 1)}
        ]
        if len(free) < 2:
            continue
        for path, first, last in free:
            taken[path] |= {*range(first, last + 1)}
        lines = [f"{path.relative_to(root)}:{first}-{last}" for path, first, last in free]
        runs.append((sizes[text] * (len(free) - 1), lines))
    return runs


def module_name(root: Path, path: Path) -> str:
    """Return the dotted name under which a file is imported."""
    return ".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__")


def imports(tree: ast.AST, name: str, is_package: bool, known: set[str]) -> set[str]:
    """Return the modules of `known` that a module imports, in functions, too."""
    targets: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            targets |= {alias.name for alias in node.names}
        if isinstance(node, ast.ImportFrom):
            above = name.split(".")[: len(name.split(".")) - node.level + is_package]
            base = ".".join([*(above if node.level else []), *filter(None, [node.module])])
            for alias in node.names:
                inner = f"{base}.{alias.name}"
                targets.add(inner if inner in known else base)
    return targets & known - {name}


def cycles(root: Path, paths: Iterable[Path]) -> list[list[str]]:
    """Return the groups of modules that import each other, those in functions counted."""
    by_name = {module_name(root, path): path for path in paths}
    known = {*by_name}
    graph = {
        name: imports(parsed(path), name, path.name == "__init__.py", known)
        for name, path in by_name.items()
    }
    index: dict[str, int] = {}
    lowest: dict[str, int] = {}
    stack: list[str] = []
    rings: list[list[str]] = []

    def visit(name: str) -> None:  # Tarjan's strongly connected components
        index[name] = lowest[name] = len(index)
        stack.append(name)
        for target in graph[name]:
            if target not in index:
                visit(target)
                lowest[name] = min(lowest[name], lowest[target])
            elif target in stack:
                lowest[name] = min(lowest[name], index[target])

        if lowest[name] == index[name]:
            ring = stack[stack.index(name) :]
            del stack[stack.index(name) :]
            if len(ring) > 1:
                rings.append(sorted(ring))

    for name in graph:
        if name not in index:
            visit(name)
    return rings


def start_up(root: Path, package: str) -> str:
    """Return what `import package` costs: milliseconds, modules, how many are ours, numpy."""
    if not (root / package).is_dir():
        return "-"
    runs = []
    for _ in range(3):
        done = subprocess.run(
            [sys.executable, "-c", IMPORT.format(package=package)],
            cwd=root,
            stdout=subprocess.PIPE,
            check=True,
        )
        runs.append(json.loads(done.stdout))
    milliseconds, modules = min(runs)
    ours = [name for name in modules if name.partition(".")[0] in PACKAGES]
    numpy = "with numpy" if "numpy" in modules else "no numpy"
    return f"{milliseconds:.0f} ms, {len(modules)} modules, {len(ours)} ours, {numpy}"


def counted(root: Path) -> list[tuple[str, str, list[str]]]:
    """Return the rows of the table: measure, value, places."""
    code = files(root, PACKAGES)
    house = without_programs(code)
    tests = files(root, ["tests"])
    measured = functions(root, code)
    starts = process_starts(root, house)
    starting_files = {where.partition(":")[0] for found in starts.values() for where in found}
    runs = repeats(root, house)
    in_exercises = repeats(
        root, [path for path in code if {"exercises", "scaffold"} & {*path.parts}]
    )
    modules = modules_of_one_name(root, house)
    classes = classes_of_one_name(root, house)
    any_type = uses_of_any(root, code)
    wide = wide_assignments(root, code)
    skipped = unformatted(root, code)
    rings = cycles(root, code)
    global_names = names_declared_global(root, house)
    asked = questions_of_type(root, house)
    applying = classes_with("apply", root, house)
    strings = sum(nodes_in(p) for path in tests for p in programs_in_strings(parsed(path)))
    largest = ", ".join(f"{room} {nodes:,}" for room, nodes in list(rooms(root).items())[:3])
    long = measured["long"]
    blankless = measured["without a blank line"]
    heavy = measured["heavy"]

    return [
        ("nodes, framelens and landscape", f"{sum(map(size, code)):,}", []),
        ("nodes, tests", f"{sum(map(size, tests)):,} ({strings:,} in strings)", []),
        ("nodes, the largest rooms", largest, []),
        ("`Any`", f"{len(any_type)}", any_type),
        ("`# fmt: skip`", f"{len(skipped)}", skipped),
        (
            "functions of 20+ lines without a blank line",
            f"{len(blankless)} of {len(long)}",
            blankless,
        ),
        ("functions of 300+ nodes", f"{len(heavy)}", heavy),
        ("tuple assignments of 3+ targets", f"{len(wide)}", wide),
        (
            "exact repeats of 40+ nodes",
            f"{sum(nodes for nodes, _ in runs):,} in {len(runs)} runs",
            [f"{nodes} {' = '.join(where)}" for nodes, where in runs],
        ),
        ("the same in the exercises", f"{sum(nodes for nodes, _ in in_exercises):,}", []),
        ("import cycles", f"{len(rings)}", [", ".join(ring) for ring in rings]),
        ("`import landscape`", start_up(root, "landscape"), []),
        ("`import framelens`", start_up(root, "framelens"), []),
        (
            "kinds of starting a process",
            f"{len(starts)} in {len(starting_files)} files",
            [f"{kind}: {', '.join(where)}" for kind, where in starts.items()],
        ),
        ("names declared global", f"{len(global_names)}", global_names),
        ("`isinstance`, `getattr`, `hasattr`", f"{len(asked)}", asked),
        ("classes with an `apply` of their own", f"{len(applying)}", applying),
        (
            "names borne by several modules",
            f"{len(modules)}",
            [f"{name}: {', '.join(where)}" for name, where in modules.items()],
        ),
        (
            "names borne by several classes",
            f"{len(classes)}",
            [f"{name}: {', '.join(where)}" for name, where in classes.items()],
        ),
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[1])
    parser.add_argument("--rooms", action="store_true", help="list the size of each room")
    parser.add_argument("--places", action="store_true", help="list where the things counted are")
    options = parser.parse_args()
    root = options.root.resolve()

    print("| Measure | Value |\n|---|---|")
    rows = counted(root)
    for measure, value, _ in rows:
        print(f"| {measure} | {value} |")
    if options.rooms:
        print()
        for room, nodes in rooms(root).items():
            print(f"{nodes:9,}  {room}")
    if options.places:
        for measure, _, places in rows:
            if places:
                print(f"\n{measure}:", *places, sep="\n  ")


if __name__ == "__main__":
    main()
