"""How the program was installed, and so how more can be installed beside it.

The distribution is `framelens`, or `landscape-gl` where the package that speaks to the user is
`landscape`.
"""

import json
import sys
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit
from urllib.request import url2pathname

from framelens.base.packages import FRAMELENS, PACKAGES, speaker

DISTRIBUTIONS = {"landscape": "landscape-gl"}  # others have their package's name
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
        return f"pipx run {added}--spec {_source()} {speaker()}"
    if (here / "uv-receipt.toml").is_file():
        return f"uv tool install {added}{_beside()}{_source()}"
    if "archive-v0" in here.parts:  # a folder of uv's cache: uvx
        return f"uvx {added}{_beside()}--from {_source()} {speaker()}"
    if not extra:
        return " ".join(("pip install", *packages))
    if checkout := _editable():
        return f'pip install -e "{checkout}[{extra}]"'
    return f'pip install "{distributed()}[{extra}]"'


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


def distributed() -> str:
    """Return the name of the distribution."""
    return DISTRIBUTIONS.get(speaker(), speaker())


def _editable() -> str:
    """Return the checkout that an editable installation is of, else ""."""
    if not _origin().get("dir_info", {}).get("editable"):
        return ""
    return str(PACKAGES[-1].folder.parent)


def _source() -> str:
    """Return the file or folder that the program was installed from; else the distribution."""
    address = urlsplit(_origin().get("url", ""))
    if address.scheme != "file":
        return distributed()
    path = Path(url2pathname(address.path))
    return f'"{path}"' if path.exists() else distributed()


def _beside() -> str:
    """Return the option that installs this package from the checkout of another one, else ""."""
    folder = Path(_source().strip('"')) / FRAMELENS.name
    return f'--with "{folder}" ' if (folder / "pyproject.toml").is_file() else ""


def _origin() -> dict[str, Any]:
    """Return what the installer noted of where the program came from; {} if from an index."""
    installed = _installed(distributed())
    origin: dict[str, Any] = json.loads(
        (installed and installed.read_text("direct_url.json")) or "{}"
    )
    return origin


def _installed(name: str) -> Distribution | None:
    try:
        return distribution(name)
    except PackageNotFoundError:
        return None
