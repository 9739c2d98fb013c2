"""The script that installs what a make target needs: which system packages apt knows."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
SETUP = ROOT / "scripts" / "setup.sh"
ANSWER = "package:\n  Installed: (none)\n  Candidate: {}\n  Version table:\n"

needs_a_shell = pytest.mark.posix_only("the script is for a shell of Linux and macOS")


def knows(folder: Path, answer: str) -> bool:
    """Return whether `apt_knows` finds a package where apt-cache prints ``answer``."""
    (folder / "answer").write_text(answer)
    apt_cache = folder / "apt-cache"
    apt_cache.write_text(f'#!/bin/sh\nexec cat "{folder}/answer"\n')
    apt_cache.chmod(0o755)
    (function,) = (line for line in SETUP.read_text().splitlines() if line.startswith("apt_knows"))
    code = f"set -euo pipefail\n{function}\napt_knows package"
    env = dict(os.environ, PATH=f"{folder}{os.pathsep}{os.environ['PATH']}")
    done = subprocess.run(["bash", "-c", code], env=env, capture_output=True, text=True)
    assert done.stderr == "" and done.returncode in (0, 1), done
    return done.returncode == 0


@needs_a_shell
@pytest.mark.parametrize("more", [0, 1, 100_000])
def test_a_package_is_found_however_many_versions_apt_lists(tmp_path: Path, more: int) -> None:
    # More lines than a pipe holds: apt-cache still writes when its first lines have been read.
    assert knows(tmp_path, ANSWER.format("1.0-2") + "     1.0-1 500\n" * more)


@needs_a_shell
@pytest.mark.parametrize("answer", ["", ANSWER.format("(none)")])
def test_a_package_that_apt_cannot_install_is_not_found(tmp_path: Path, answer: str) -> None:
    assert not knows(tmp_path, answer)


@needs_a_shell
def test_a_package_that_cannot_be_installed_does_not_stop_the_others(tmp_path: Path) -> None:
    tools = {
        "id": "echo 0",
        "apt-cache": f"cat <<'END'\n{ANSWER.format('1.0')}END",
        "apt-get": f'case "$*" in *removed*) exit 100 ;; esac; echo "$*" >>"{tmp_path}/calls"',
    }
    for name, script in tools.items():
        (tmp_path / name).write_text(f"#!/bin/sh\n{script}\n")
        (tmp_path / name).chmod(0o755)
    functions = SETUP.read_text().partition("\nsay()")[2].partition("# --- Python")[0]
    code = f"set -euo pipefail\nsay(){functions}\napt_install one removed two"
    env = dict(os.environ, PATH=f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    done = subprocess.run(["bash", "-c", code], env=env, capture_output=True, text=True)
    assert done.returncode == 1, done
    calls = (tmp_path / "calls").read_text().splitlines()
    installed = [call.split()[-1] for call in calls if call.startswith("install")]
    assert installed == ["one", "two"]


def test_the_linters_and_what_they_read_have_exact_versions() -> None:
    lines = (ROOT / "requirements-lint.txt").read_text(encoding="utf-8").splitlines()
    pinned = [line for line in lines if line and not line.startswith("#")]
    assert {"ruff", "mypy", "numpy", "pillow"} <= {line.split("==")[0] for line in pinned}
    assert all(re.fullmatch(r"[\w-]+==[\d.]+", line) for line in pinned), pinned


@needs_a_shell
@pytest.mark.parametrize(("system", "status"), [("Darwin", 0), ("Linux", 1)])
def test_only_linux_needs_a_variable_that_names_the_display(
    tmp_path: Path, system: str, status: int
) -> None:
    (tmp_path / "scripts").mkdir()
    (tmp_path / "scripts" / "setup.sh").write_text(SETUP.read_text())
    opens = tmp_path / ".venv" / "bin" / "python"
    opens.parent.mkdir(parents=True)
    for tool, answer in ((opens, "exit 0"), (tmp_path / "uname", f"echo {system}")):
        tool.write_text(f"#!/bin/sh\n{answer}\n")
        tool.chmod(0o755)
    kept = {"PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}"}
    command = ["bash", str(tmp_path / "scripts" / "setup.sh"), "screen"]
    assert subprocess.run(command, env=kept).returncode == status


@needs_a_shell
def test_the_processors_are_counted_without_the_tool_of_linux(tmp_path: Path) -> None:
    for tool in ("bash", "make", "getconf"):
        path = shutil.which(tool)
        if path is None:
            pytest.skip(f"{tool} is not installed")
        (tmp_path / tool).symlink_to(path)
    # Its variables, with a target that -n only prints: what calls $(MAKE), as `test`, it would run.
    command = [str(tmp_path / "make"), "-n", "-p", "-C", str(ROOT), "clean"]
    done = subprocess.run(command, env={"PATH": str(tmp_path)}, capture_output=True, text=True)
    assert re.search(r"^WORKERS := [234]$", done.stdout, re.MULTILINE), done
