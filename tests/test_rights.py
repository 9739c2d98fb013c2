"""Files and folders that one may not read, enter or write are named, with what is wrong."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from commands import SECONDS, Done, bound_by_rights, environment, refused

pytestmark = [
    pytest.mark.posix_only("files have no such rights"),
    pytest.mark.skipif(
        hasattr(os, "geteuid") and os.geteuid() == 0 and shutil.which("setpriv") is None,
        reason="nothing is forbidden to root without setpriv (util-linux)",
    ),
]


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A folder with files and folders of few rights."""
    path = tmp_path_factory.mktemp("rights")
    for name in ("secret.png", "secret.toml"):
        (path / name).write_bytes(b"secret")
        (path / name).chmod(0)
    (path / "kept.png").write_bytes(b"kept")
    (path / "kept.png").chmod(0o444)
    for name, rights in (("closed", 0), ("blind", 0o311), ("fixed", 0o555)):
        (path / name).mkdir()
        (path / name).chmod(rights)
    yield path
    for name in ("closed", "blind", "fixed"):
        (path / name).chmod(0o755)


def run(place: Path, *words: str) -> Done:
    """Run `landscape WORDS` in a process that is bound by rights."""
    command = [*bound_by_rights(), sys.executable, "-m", "landscape", *words]
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=SECONDS, env=environment(), cwd=place
    )
    return Done(done.returncode, done.stdout, done.stderr)


DRAW = ("render", "fig4a", "--size=64x48", "--preset=2006", "--only=map")


@pytest.mark.seldom(14, first=3)
@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((*DRAW, "--assets=closed"), "closed: expected a folder that can be read"),
        ((*DRAW, "--assets=blind"), "blind: expected a folder that can be read"),
        ((*DRAW, "--settings=secret.toml"), "secret.toml: cannot be read (Permission denied)"),
        ((*DRAW, "--set=ground.height_image=secret.png"), "secret.png: cannot be read (Permission"),
        (
            (*DRAW, "--set=ground.height_image=closed/a.png"),
            "setting ground.height_image: closed/a.png: cannot be read (Permission denied)",
        ),
        ((*DRAW, "--out=closed/a.png"), "closed/a.png: cannot be written (Permission denied)"),
        ((*DRAW, "--out=fixed/a.png"), "fixed/a.png: expected a folder that can be written"),
        ((*DRAW, "--out=kept.png"), "kept.png: cannot be written (Permission denied)"),
    ],
)
def test_what_is_forbidden_is_refused_by_name(
    words: tuple[str, ...], said: str, place: Path
) -> None:
    refused(run(place, *words), said)
    assert (place / "kept.png").read_bytes() == b"kept"
