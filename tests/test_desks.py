"""The smoke test of a computer, scripts/desks/smoke.py, and the workflow that runs it."""

import json
import re
import subprocess
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from PIL import Image

from landscape.cli import parse
from landscape.scene.scene import find_view

ROOT = Path(__file__).parents[1]
WORKFLOW = (ROOT / ".github" / "workflows" / "desks.yml").read_text(encoding="utf-8")


@pytest.fixture
def smoke() -> ModuleType:
    spec = spec_from_file_location("smoke", ROOT / "scripts" / "desks" / "smoke.py")
    assert spec and spec.loader
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def fill(folder: Path, smoke: ModuleType, level: int = 100) -> Path:
    """Write stills of one grey level."""
    (folder / "stills").mkdir(parents=True)
    picture = Image.fromarray(np.full((18, 32, 3), level, np.uint8))
    for name in smoke.STILLS:
        picture.save(folder / "stills" / f"{name}.png")
    return folder


def test_every_command_of_the_smoke_test_is_one_of_the_program(
    smoke: ModuleType, tmp_path: Path
) -> None:
    for step in smoke.steps(tmp_path, "640x360"):
        parse(step.words)
    found = [find_view(name) for name in smoke.STILLS]
    assert len({view.name for _, view in found}) == 12
    assert {scene.name for scene, _ in found} == {"island", "hall", "voxel"}


@pytest.mark.seldom(13, first=4)
def test_a_step_that_fails_is_told_and_the_others_are_run(
    smoke: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    first = smoke.Step("first", ("views", "--json"), output="first.json")
    some = (first, smoke.Step("wrong", ("render", "nosuch")), smoke.Step("views", ("views",)))
    monkeypatch.setattr(smoke, "steps", lambda out, size: some)
    assert smoke.smoke(tmp_path, "64x36") == 1
    told = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in told] == ["first", "wrong", "views"]
    assert "status 2, not 0: landscape: " in told[1] and told[2].endswith(" ok")
    assert (tmp_path / "smoke.txt").read_text(encoding="utf-8").splitlines() == told
    assert json.loads((tmp_path / "first.json").read_text(encoding="utf-8"))


def test_another_backend_than_the_one_expected_is_a_fault(
    smoke: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    monkeypatch.setattr(smoke, "steps", lambda out, size: [smoke.Step("doctor", ())])
    monkeypatch.setattr(smoke, "run", lambda step, out: "")
    (tmp_path / "doctor.json").write_text('{"chosen": "egl"}', encoding="utf-8")
    assert smoke.smoke(tmp_path, "64x36", "egl") == 0
    assert smoke.smoke(tmp_path, "64x36", "osmesa") == 1
    assert "takes egl, not osmesa" in capsys.readouterr().out


def test_stills_that_differ_are_kept_with_what_was_expected(
    smoke: ModuleType, tmp_path: Path, capsys
) -> None:
    here, there = fill(tmp_path / "here", smoke), fill(tmp_path / "there", smoke, 101)
    assert smoke.compare(here, there) == 0, "another renderer may differ by a level"
    assert not (here / "differ").exists()
    Image.fromarray(np.full((18, 32, 3), 180, np.uint8)).save(here / "stills" / "hall.png")
    (here / "stills" / "voxel.png").unlink()
    assert smoke.compare(here, there) == 1
    told = capsys.readouterr().out
    assert "100.00% of the pixels" in told and "voxel.png is missing" in told
    kept = sorted(path.name for path in (here / "differ").iterdir())
    assert kept == [f"hall-{kind}.png" for kind in ("actual", "difference", "expected")]


def test_the_script_says_what_it_takes() -> None:
    words = [sys.executable, str(ROOT / "scripts" / "desks" / "smoke.py"), "--help"]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert "--takes" in done.stdout and "--compare" in done.stdout


def test_the_workflow_says_that_it_was_not_run_and_pins_every_action() -> None:
    assert "has not been run" in WORKFLOW[:300]
    actions = re.findall(r"uses: (\S+)", WORKFLOW)
    assert len(actions) >= 6
    assert all(re.fullmatch(r"[\w/-]+@[0-9a-f]{40}", action) for action in actions)


def test_the_scripts_that_the_workflow_runs_exist() -> None:
    scripts = set(re.findall(r"scripts/[\w./]+", WORKFLOW))
    assert scripts == {"scripts/setup.sh", "scripts/desks/smoke.py"}
    assert all((ROOT / script).is_file() for script in scripts)


def test_the_stills_of_every_desk_but_the_small_one_are_compared() -> None:
    desks = re.findall(r"- name: ([\w-]+)\n +runner:", WORKFLOW)
    (compared,) = re.findall(r"for desk in ([\w -]+);", WORKFLOW)
    assert set(desks) == {*compared.split(), "ubuntu-osmesa", "macos"}
