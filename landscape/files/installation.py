"""How the program was installed, and so how more can be installed beside it.

The distribution is named `landscape-gl`; the package and the command that it installs, `landscape`.
"""

import json
import sys
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit
from urllib.request import url2pathname

NAME = "landscape-gl"
STRANGER = "landscape"  # somebody else's distribution, with a package and a command of this name


def how_to_add(*packages: str, extra: str = "") -> str:
    """Return the command that installs packages beside the program; ``extra`` stands for them all.

    It is one of pipx or uv in their environments; in a checkout, an extra installs that again.
    """
    here = Path(sys.prefix)
    added = "".join(f"--with {package} " for package in packages)
    if (here / "pipx_metadata.json").is_file():
        if here.parent.name == "venvs":
            return " ".join(("pipx inject", here.name, *packages))
        return f"pipx run {added}--spec {_source()} landscape"
    if (here / "uv-receipt.toml").is_file():
        return f"uv tool install {added}{_source()}"
    if "archive-v0" in here.parts:  # a folder of uv's cache: uvx
        return f"uvx {added}--from {_source()} landscape"
    if not extra:
        return " ".join(("pip install", *packages))
    checkout = _editable()
    return f'pip install -e "{checkout}[{extra}]"' if checkout else f'pip install "{NAME}[{extra}]"'


def conflict() -> str:
    """Return a line where a distribution that writes to the same folder is installed, or ""."""
    other = _installed(STRANGER)
    if other is None:
        return ""
    again = f'-e "{checkout}"' if (checkout := _editable()) else _source()
    return (
        f"{STRANGER} {other.version}, another distribution, has the same package and command: "
        f"run `pip uninstall {STRANGER}`, then `pip install --force-reinstall {again}`"
    )


def _editable() -> str:
    """Return the checkout that an editable installation is of, else ""."""
    if not _origin().get("dir_info", {}).get("editable"):
        return ""
    return str(Path(__file__).resolve().parents[2])


def _source() -> str:
    """Return the file or folder that the program was installed from, if it is there; else NAME."""
    address = urlsplit(_origin().get("url", ""))
    if address.scheme != "file":
        return NAME
    path = Path(url2pathname(address.path))
    return f'"{path}"' if path.exists() else NAME


def _origin() -> dict[str, Any]:
    """Return what the installer noted of where the program came from; {} if from an index."""
    installed = _installed(NAME)
    origin: dict[str, Any] = json.loads(
        (installed and installed.read_text("direct_url.json")) or "{}"
    )
    return origin


def _installed(name: str) -> Distribution | None:
    try:
        return distribution(name)
    except PackageNotFoundError:
        return None
