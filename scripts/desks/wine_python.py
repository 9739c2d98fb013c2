"""A real Windows CPython 3.11 under Wine, made of what package registries have.

The wheel of panda3d for Windows carries CPython's own python311.dll and extension modules. The
standard library is that of a Python 3.11 here. python.exe (python.c), python3.dll, which libraries
for several versions of Python ask for, and numpy's complex functions are compiled.

It lacks Windows' own drivers, window manager and some of its file locking; Mesa draws. What Python
lacks on Windows, it lacks here, too.
"""

import contextlib
import os
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import complex_functions

HERE = Path(__file__).parent
CHECKOUT = HERE.parents[1]
FOLDER = CHECKOUT / "build" / "windows"
PYTHON = FOLDER / "python"
SOURCE = "panda3d==1.10.16"
TOOLS = {
    "wine": "wine wine64",
    complex_functions.COMPILER: "gcc-mingw-w64-x86-64",
    "Xvfb": "xvfb",
}
TARGET = ("--platform=win_amd64", "--python-version=311", "--only-binary=:all:")
# Not extension modules: libraries that extension modules load.
LIBRARIES = ["libffi-8", "libcrypto-3", "libssl-3", "sqlite3", "tcl86t", "tk86t"]
LEFT_OUT = re.compile(r"\./(site-packages|lib-dynload|test|config-[^/]*)(/|$)|.*/__pycache__(/|$)")
# A class method in late releases of Python 3.11, a method in earlier ones.
LATE_METHOD = re.compile(r"(?<!@classmethod\n)    def invalidate_caches\(cls\)")

# A process with a window, hidden. As long as there is one, Wine's desktop stays. A later program
# would start another desktop, which would keep the program's pipes open.
HOLDER = """
import glfw, sys
assert glfw.init()
glfw.window_hint(glfw.VISIBLE, False)
window = glfw.create_window(8, 8, "holder", None, None)
print("ready", flush=True)
sys.stdin.read()
"""


class MissingError(Exception):
    """What this computer lacks, in one line."""


def make() -> None:
    """Make the Python, unless it is there, and install the checkout with its tests' packages."""
    missing = [package for tool, package in TOOLS.items() if shutil.which(tool) is None]
    if missing:
        raise MissingError(f"install {' '.join(missing)} (packages of Debian and Ubuntu)")
    if not (PYTHON / "python.exe").exists():
        make_python()
    install()
    complex_functions.add(PYTHON)


def make_python() -> None:
    """Make the Python without packages, and Wine's folder."""
    wheels = FOLDER / "wheels"
    shutil.rmtree(PYTHON, ignore_errors=True)
    (PYTHON / "DLLs").mkdir(parents=True)
    _pip("download", "--no-deps", *TARGET, SOURCE, "-d", str(wheels))
    with zipfile.ZipFile(next(wheels.glob("panda3d*.whl"))) as wheel:
        for name in wheel.namelist():
            if re.fullmatch(r"deploy_libs/(?!api-ms-).*\.(dll|pyd)", name):
                apart = name.endswith(".pyd") or Path(name).stem in LIBRARIES
                place = PYTHON / "DLLs" if apart else PYTHON
                (place / Path(name).name).write_bytes(wheel.read(name))
    copy_standard_library()
    exports = re.findall(r"^\s+\[ *\d+\].*?\s(_?Py\w+)$", _exports(), re.MULTILINE)
    names = [f"  {name} = python311.{name}" for name in sorted(set(exports))]
    complex_functions.library(PYTHON / "python3.dll", names)
    _wine(["wineboot", "-i"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    compiled = [complex_functions.COMPILER, "-municode", "-O1", str(HERE / "python.c")]
    subprocess.run([*compiled, "-o", str(PYTHON / "python.exe")], check=True)


def copy_standard_library() -> None:
    """Copy the standard library of a Python 3.11 of this computer."""
    python = sys.executable if sys.version_info[:2] == (3, 11) else shutil.which("python3.11")
    if not python:
        raise MissingError("install Python 3.11: its standard library is needed")
    code = "import sysconfig; print(sysconfig.get_paths()['stdlib'])"
    done = subprocess.run([python, "-c", code], capture_output=True, text=True, check=True)
    library = Path(done.stdout.strip())
    for path in library.rglob("*"):
        name = f"./{path.relative_to(library)}"
        if path.is_file() and not LEFT_OUT.match(name):
            place = PYTHON / "Lib" / name
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, place)
    # The DLL is of a late release, and calls this method on the class.
    metadata = PYTHON / "Lib" / "importlib" / "metadata" / "__init__.py"
    text = metadata.read_text(encoding="utf-8")
    metadata.write_text(LATE_METHOD.sub(r"    @classmethod\n\g<0>", text), encoding="utf-8")


def install() -> None:
    """Install the checkout, as it is now, with the packages that its tests need."""
    built = FOLDER / "wheel"
    shutil.rmtree(built, ignore_errors=True)
    _pip("wheel", "--no-deps", str(CHECKOUT), "-w", str(built))
    (wheel,) = built.glob("*.whl")
    place = PYTHON / "Lib" / "site-packages"
    shutil.rmtree(place, ignore_errors=True)
    _pip("install", "--target", str(place), *TARGET, f"{wheel}[test,fast]")


def run(*words: str, cwd: Path = CHECKOUT, seconds: float | None = None) -> int:
    """Run python.exe with its output shown; return the exit status. TimeoutExpired if late."""
    command = ["wine", str(PYTHON / "python.exe"), *words]
    with _started(command, cwd, subprocess.DEVNULL) as process:
        assert process.stdout is not None
        for line in process.stdout:
            print(line, end="", flush=True)
        return process.wait(seconds)


@contextlib.contextmanager
def screen() -> Iterator[None]:
    """Give the programs of the block a screen, with a window that keeps Wine's desktop."""
    read, write = os.pipe()
    words = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp"]
    server = subprocess.Popen(words, pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)

    try:
        with os.fdopen(read) as pipe:
            os.environ["DISPLAY"] = f":{pipe.readline().strip()}"
        command = ["wine", str(PYTHON / "python.exe"), "-c", HOLDER]
        with _started(command, CHECKOUT, subprocess.PIPE) as holder:
            assert holder.stdout is not None and holder.stdin is not None
            if not any(line.strip() == "ready" for line in holder.stdout):
                raise MissingError("no window opens under Wine")
            try:
                yield
            finally:
                holder.stdin.close()
    finally:
        server.terminate()
        server.wait()


def _started(command: list[str], cwd: Path, given: int) -> "subprocess.Popen[str]":
    """Start a program of Wine; ``given`` is its standard input."""
    # Python under Wine wants pipes for its streams, not files.
    streams = {"stdin": given, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    return subprocess.Popen(
        command, cwd=cwd, env=_environment(), text=True, errors="replace", **streams
    )


def _wine(command: list[str], stdout: int, stderr: int) -> None:
    subprocess.run(command, env=_environment(), stdout=stdout, stderr=stderr, timeout=300)


def _environment() -> dict[str, str]:
    """Return the environment of Wine, with its folder."""
    own = {"WINEPREFIX": str(FOLDER / "prefix"), "WINEDEBUG": "-all", "WINEARCH": "win64"}
    return {**os.environ, **own}


def _exports() -> str:
    return complex_functions.listing(PYTHON / "python311.dll").partition("[Ordinal/Name")[2]


def _pip(*words: str) -> None:
    subprocess.run([sys.executable, "-m", "pip", "-q", *words], check=True)
