"""How the program was installed, and so how more can be installed beside it.

The distribution is named `landscape-gl`; the package and the command that it installs, `landscape`.
"""

import json
import sys
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path

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
        return f"pipx run {added}--spec {NAME} landscape"
    if (here / "uv-receipt.toml").is_file():
        return f"uv tool install {added}{NAME}"
    if "archive-v0" in here.parts:  # a folder of uv's cache: uvx
        return f"uvx {added}--from {NAME} landscape"
    if not extra:
        return " ".join(("pip install", *packages))
    checkout = _editable()
    return f'pip install -e "{checkout}[{extra}]"' if checkout else f'pip install "{NAME}[{extra}]"'


def conflict() -> str:
    """Return a line where a distribution that writes to the same folder is installed, or ""."""
    other = _installed(STRANGER)
    if other is None:
        return ""
    return (
        f"{STRANGER} {other.version}, another distribution, has the same package and command: "
        f"run `pip uninstall {STRANGER}`, then `pip install --force-reinstall {NAME}`"
    )


def _editable() -> str:
    """Return the checkout that an editable installation is of, else ""."""
    installed = _installed(NAME)
    origin = json.loads((installed and installed.read_text("direct_url.json")) or "{}")
    if not origin.get("dir_info", {}).get("editable"):
        return ""
    return str(Path(__file__).resolve().parents[2])


def _installed(name: str) -> Distribution | None:
    try:
        return distribution(name)
    except PackageNotFoundError:
        return None
