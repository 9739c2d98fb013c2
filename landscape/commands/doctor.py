"""Which OpenGL backends work here. PyOpenGL binds to one, so each is tried in its own process."""

import argparse
import json
import platform
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from framelens.base.errors import NoOpenGLError, located
from framelens.base.installation import conflict, distributed
from framelens.base.isolated import Ended, isolated
from framelens.commands.common import json_option
from framelens.gl import context
from framelens.gl.extensions import texture_units, widest_line
from framelens.gl.seam import gl
from landscape.files import cache
from landscape.gl.features import left_out

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


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    json_option(parser)


def run(options: argparse.Namespace) -> int:
    """Examine, and report; return the exit status: 3 if no backend works."""
    findings = examine()
    print(json.dumps(findings, indent=1) if options.json else report(findings))
    return 0 if findings["chosen"] else 3


def examine() -> dict[str, object]:
    """Return what `landscape doctor --json` prints: backends, the one `auto` takes, versions."""
    backends = {name: probe(name) for name in context.BACKENDS}
    chosen = next((name for name in context.BACKENDS if backends[name]["ok"]), None)
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


def probe(backend: str) -> dict[str, object]:
    """Open a context in another process; return ok, with renderer and version or a reason."""
    try:
        return isolated(look_at, backend, seconds=SECONDS)
    except Ended as ended:
        if ended.status is None:
            return {"ok": False, "reason": f"no answer in {SECONDS} seconds"}
        last = ended.message or "no message"
        return {"ok": False, "reason": f"the process ended with {ended.status}: {last}"}


def look_at(backend: str) -> dict[str, object]:
    """Return what :func:`probe` does, from a context that is opened in this process."""
    try:
        opened = context.open_context(backend)
        names = gl.GL_RENDERER, gl.GL_VERSION
        renderer, number = (gl.glGetString(name).decode() for name in names)
        state = {
            "ok": True,
            "renderer": renderer,
            "version": number,
            "units": texture_units(),
            "widest_line": widest_line(),
            "off": left_out(),
        }
        opened.release()
        return state
    except NoOpenGLError as error:
        return {"ok": False, "reason": str(error)}
    except Exception as error:
        return {"ok": False, "reason": located(error)}


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
