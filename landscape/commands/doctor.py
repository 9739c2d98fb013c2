"""Which OpenGL backends work here. PyOpenGL binds to one, so each is tried in its own process."""

import argparse
import json
import platform
import subprocess
import sys
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from framelens.base.installation import conflict, distributed
from framelens.commands.common import json_option
from framelens.gl.context import BACKENDS
from landscape.files import cache

EXAMPLE = "--json"
PACKAGES = (
    distributed(),
    "PyOpenGL",
    "PyOpenGL-accelerate",
    "glfw",
    "numpy",
    "pillow",
    "trimesh",
    "platformdirs",
    "polib",
    "tqdm",
    "svgelements",
)
OPTIONAL = ("PyOpenGL-accelerate",)
SECONDS = 60  # chosen: a backend that takes longer is considered to hang

_PROBE = """
import json, sys
from framelens.base.errors import NoOpenGLError, located
from framelens.gl.seam import gl
from framelens.gl.context import open_context
from framelens.gl.extensions import texture_units, widest_line
from landscape.gl.features import left_out
try:
    context = open_context(sys.argv[1])
    names = gl.GL_RENDERER, gl.GL_VERSION
    renderer, version = (gl.glGetString(name).decode() for name in names)
    found = {"ok": True, "renderer": renderer, "version": version}
    found |= {"units": texture_units(), "widest_line": widest_line(), "off": left_out()}
    context.release()
    print(json.dumps(found))
except NoOpenGLError as error:
    print(json.dumps({"ok": False, "reason": str(error)}))
except Exception as error:
    print(json.dumps({"ok": False, "reason": located(error)}))
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    json_option(parser)


def run(options: argparse.Namespace) -> int:
    """Examine, and report; return the exit status: 3 if no backend works."""
    findings = examine()
    print(json.dumps(findings, indent=1) if options.json else report(findings))
    return 0 if findings["chosen"] else 3


def examine() -> dict[str, Any]:
    """Return what `landscape doctor --json` prints: backends, the one `auto` takes, versions."""
    backends = {name: probe(name) for name in BACKENDS}
    chosen = next((name for name in BACKENDS if backends[name]["ok"]), None)
    packages = {}
    for name in PACKAGES:
        try:
            packages[name] = version(name)
        except PackageNotFoundError:
            packages[name] = "missing (optional)" if name in OPTIONAL else "missing"
    return {
        "backends": backends,
        "chosen": chosen,
        "python": platform.python_version(),
        "packages": packages,
        "conflict": conflict(),
        "cache": {"folder": str(cache.folder() or ""), "reason": cache.trouble()},
    }


def probe(backend: str) -> dict[str, Any]:
    """Open a context in another process; return ok, with renderer and version or a reason."""
    command = [sys.executable, "-c", _PROBE, backend]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS)
        result: dict[str, Any] = json.loads(done.stdout.strip().splitlines()[-1])
        return result
    except subprocess.TimeoutExpired:
        return {"ok": False, "reason": f"no answer in {SECONDS} seconds"}
    except (IndexError, json.JSONDecodeError):
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        return {"ok": False, "reason": f"the process ended with {done.returncode}: {last}"}


def abilities(state: dict[str, Any]) -> list[str]:
    """Return what a backend's OpenGL has and lacks, as lines."""
    has = f"{state['units']} texture units, lines up to {state['widest_line']:g} pixels wide"
    off = [f"off: {'; '.join(names)} ({why})" for why, names in state["off"].items()]
    return [has, *(off or ["nothing that a picture shows is left out"])]


def report(found: dict[str, Any]) -> str:
    """Return the findings as text."""
    lines = []
    for name, state in found["backends"].items():
        if state["ok"]:
            lines.append(f"{name:8} ok   {state['renderer']}, OpenGL {state['version']}")
            lines += [f"{'':13} {line}" for line in abilities(state)]
        else:
            lines.append(f"{name:8} no   {state['reason']}")
    lines.append(f"`auto` takes {found['chosen'] or 'none: each line above says what is missing'}")
    if found["cache"]["reason"]:
        lines.append(f"nothing is cached, so each start is slow: {found['cache']['reason']}")
    else:
        lines.append(f"cache: {found['cache']['folder'] or 'off'}")
    if found["conflict"]:
        lines.append(found["conflict"])
    lines.append(f"Python {found['python']}")
    lines += [f"{name} {number}" for name, number in found["packages"].items()]
    return "\n".join(lines)
