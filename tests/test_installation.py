"""How more is installed: the command fits how the program itself was."""

import json
import sys
from pathlib import Path

import pytest

from framelens.base import installation
from framelens.base.installation import conflict, how_to_add
from landscape.commands import doctor

ROOT = Path(__file__).parents[1]


class Installed:
    """A distribution, with what pip noted of where it came from."""

    def __init__(self, origin: dict | None = None, version: str = "0.1.1") -> None:
        self.origin, self.version = origin, version

    def read_text(self, name: str) -> str | None:
        assert name == "direct_url.json"
        return json.dumps(self.origin) if self.origin else None


@pytest.fixture
def installed(monkeypatch: pytest.MonkeyPatch) -> dict[str, Installed]:
    """What is installed, by name: at first this program from an index, and nothing else."""
    found = {"landscape-gl": Installed()}
    monkeypatch.setattr(installation, "_installed", found.get)
    return found


def test_pip_is_told_the_distribution_and_the_extra(installed: dict[str, Installed]) -> None:
    assert how_to_add("av", extra="film") == 'pip install "landscape-gl[film]"'


def test_pip_installs_what_no_extra_stands_for_by_its_name(installed: dict[str, Installed]) -> None:
    installed["landscape-gl"].origin = {"url": ROOT.as_uri(), "dir_info": {"editable": True}}
    assert how_to_add("pygame") == "pip install pygame"


def test_in_a_checkout_the_checkout_is_installed_again(installed: dict[str, Installed]) -> None:
    installed["landscape-gl"].origin = {"url": ROOT.as_uri(), "dir_info": {"editable": True}}
    assert how_to_add("av", extra="film") == f'pip install -e "{ROOT}[film]"'


def test_a_wheel_from_a_file_is_no_checkout(installed: dict[str, Installed]) -> None:
    installed["landscape-gl"].origin = {"url": "file:///downloads/a.whl", "archive_info": {}}
    assert how_to_add("av", extra="film") == 'pip install "landscape-gl[film]"'


@pytest.mark.parametrize(
    ("folder", "mark", "command"),
    [
        ("pipx/venvs/landscape-gl", "pipx_metadata.json", "pipx inject landscape-gl av pip"),
        (
            "pipx/.cache/013",
            "pipx_metadata.json",
            "pipx run --with av --with pip --spec landscape-gl landscape",
        ),
        (
            "tools/landscape-gl",
            "uv-receipt.toml",
            "uv tool install --with av --with pip landscape-gl",
        ),
        (
            "uv/archive-v0/LlS",
            "pyvenv.cfg",
            "uvx --with av --with pip --from landscape-gl landscape",
        ),
    ],
)
def test_pipx_and_uv_have_commands_of_their_own(
    folder: str,
    mark: str,
    command: str,
    installed: dict[str, Installed],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    here = tmp_path / folder
    here.mkdir(parents=True)
    (here / mark).touch()
    monkeypatch.setattr(sys, "prefix", str(here))
    assert how_to_add("av", "pip") == how_to_add("av", "pip", extra="film") == command


def test_what_was_installed_from_a_file_is_installed_from_it_again(
    installed: dict[str, Installed], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    checkout = tmp_path / "my île"
    checkout.mkdir()
    installed["landscape-gl"].origin = {"url": checkout.as_uri(), "dir_info": {}}
    installed["landscape"] = Installed()
    assert conflict().endswith(f'`pip install --force-reinstall "{checkout}"`')
    (tmp_path / "uv-receipt.toml").touch()
    monkeypatch.setattr(sys, "prefix", str(tmp_path))
    assert how_to_add("av") == f'uv tool install --with av "{checkout}"'
    checkout.rmdir()  # nothing can be installed from it any more
    assert how_to_add("av") == "uv tool install --with av landscape-gl"


def test_a_checkout_beside_another_distribution_is_installed_again(
    installed: dict[str, Installed],
) -> None:
    installed["landscape-gl"].origin = {"url": ROOT.as_uri(), "dir_info": {"editable": True}}
    installed["landscape"] = Installed()
    assert conflict().endswith(f'`pip install --force-reinstall -e "{ROOT}"`')


def test_another_distribution_of_the_packages_name_is_told_by_doctor(
    installed: dict[str, Installed], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(doctor, "probe", lambda name: {"ok": False, "reason": "not asked"})
    assert conflict() == ""
    quiet = doctor.report(doctor.examine()).splitlines()
    installed["landscape"] = Installed()
    lines = doctor.report(doctor.examine()).splitlines()
    (told,) = [line for line in lines if line not in quiet]
    assert told.startswith("landscape 0.1.1, another distribution, ")
    assert "pip uninstall landscape" in told
