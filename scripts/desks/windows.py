"""Try the program on Windows, by Wine: `make test-windows`.

A real Windows Python is made in build/windows (wine_python.py) and gets the checkout. Then smoke.py
runs there, its stills are compared with those that are drawn here, the commands of COMMANDS are
run, and the tests. With arguments, only these are done: `tests/test_cli.py` or other arguments of
pytest, or `-m landscape ...` for a command. The first time takes some minutes, the tests hours.
"""

import subprocess
import sys

import smoke
import wine_python

OUT = wine_python.FOLDER / "out"
HERE_OUT = wine_python.FOLDER / "here"
SIZE = "640x360"
TINY = ("--size", "160x120", "--preset", "2006")
PROGRAMS = wine_python.CHECKOUT / "tests" / "programs"

# Each is to end with status 0. They run in OUT, one after another.
COMMANDS = (
    ("--help",),
    ("--version",),
    ("settings", "fog"),
    ("views",),
    ("figures", "fig4a", "--out", "figures", "-q"),
    *(("trace", f"{name}.py") for name in ("lantern", "windmill", "waves")),
    ("pixel", "lantern.py", "100,100"),
    ("state", "lantern.py"),
    ("strip", "lantern.py", "--out", "strip.png"),
    ("film", "fig4a", *TINY, "--seconds", "0.3", "--out", "film.mp4", "--jobs", "2"),
    ("film", "fig4a", *TINY, "--seconds", "0.3", "--out", "film.gif", "--jobs", "1"),
    ("flyover", "--size", "160x120", "--frames", "3", "--out", "flight.mp4", "--jobs", "2"),
    ("flyover", "--size", "160x120", "--frames", "3", "--jobs", "2"),
    ("flyover", "--size", "160x120", "--frames", "1", "--bench"),
    ("lesson", "mirror", "--copy", "lesson"),
    ("lecture", "--list"),
    ("walk", "fig4a", *TINY, "--only", "map", "--frames", "5", "--record", "walk.jsonl"),
    ("walk", "--replay", "walk.jsonl", "--frames", "3"),
    ("bench", "fig4a", *TINY),
    ("assets", "check"),
)


def main() -> int:
    """Run the command line and return the exit status."""
    try:
        wine_python.make()
        with wine_python.screen():
            words = sys.argv[1:]
            if words[:1] == ["-m"]:
                return wine_python.run(*words)
            return tests(words) if words else all_of_it()
    except wine_python.MissingError as error:
        print(f"test-windows: {error}", file=sys.stderr)
        return 2


def all_of_it() -> int:
    """Do everything; return the exit status."""
    faults = pictures() + commands() + tests(["tests"])
    return 1 if faults else 0


def pictures() -> int:
    """Run smoke.py here and there; return how many of three steps failed."""
    script = str(wine_python.HERE / "smoke.py")
    size = ["--size", SIZE]
    here = [sys.executable, script, "--out", str(HERE_OUT), *size]
    failed = subprocess.run(here).returncode != 0
    failed += wine_python.run(script, "--out", str(OUT), *size, "--takes", "glfw") != 0
    return failed + smoke.compare(OUT, HERE_OUT)


def commands() -> int:
    """Run COMMANDS; say how each ended, and return how many failed."""
    for path in PROGRAMS.glob("*.py"):
        (OUT / path.name).write_bytes(path.read_bytes())
    failed = 0
    for words in COMMANDS:
        status = wine_python.run("-m", "landscape", *words, cwd=OUT)
        failed += status != 0
        print(f"status {status}: landscape {' '.join(words)}", flush=True)
    return failed


def tests(words: list[str]) -> int:
    """Run pytest there; return its exit status."""
    return wine_python.run("-m", "pytest", "-q", "-p", "no:cacheprovider", *words)


if __name__ == "__main__":
    sys.exit(main())
