"""No named view calls an entry point on the list of shaders_none/forbidden.txt.

The list itself is tested in test_no_shader_list.py; test_calls.py tests that only the files of
landscape/gl can bypass the seam.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from stage import SMALL, SMALL_BEST, write_plain, write_ply
from sweeps import Todays

from framelens.gl.seam import Call, gl, recording
from landscape.elements import atlas
from landscape.elements.atlas import CELLS
from landscape.elements.best.castle import ornate_castle, weathered_castle
from landscape.elements.best.sprites import refined_atlas
from landscape.elements.settings import PRESETS
from landscape.elements.water_surface import WaterSurface
from landscape.geometry.mesh import Mesh
from landscape.island.views import VIEWS
from landscape.offscreen import Offscreen

LIST = Path(__file__).resolve().parents[1] / "shaders_none" / "forbidden.txt"
FEW = {name: SMALL_BEST if name == "best" else SMALL for name in PRESETS}
MANY = {"grass.count": 20_000}
FORBIDDEN = frozenset(
    line for line in LIST.read_text(encoding="utf-8").splitlines() if line[:1] not in ("", "#")
)

# What views change of their preset, each once.
SETTINGS = [*{str(v.settings): v.settings for v in VIEWS.values() if v.settings}.values()]


def called(calls: list[Call]) -> set[str]:
    """Return the names of all calls, those inside display lists as well."""
    names: set[str] = set()
    for call in calls:
        names |= {call.name} | called(call.listed)
    return names


def quick_assets(folder: Path) -> Path:
    """Fill a folder with small pictures and meshes: which calls are made does not depend on them.

    The height images are the shipped ones: what comes into view does depend on those.
    """
    sprites = {name: (90, 120, 60, 255) for name in CELLS}
    write_plain(folder, {**sprites, "ground_large.png": (60, 140, 40)})
    (folder / "height.png").unlink()
    for name in ("rabbit.ply", "dragon.ply"):
        write_ply(folder / name, np.eye(4, 3), np.array([(0, 1, 2), (0, 2, 3), (0, 3, 1)]))
    return folder


def quick_levels(image: np.ndarray, levels: int) -> list[np.ndarray]:
    return [np.ascontiguousarray(image[:: 1 << k, :: 1 << k]) for k in range(levels)]


def quick_light(mesh: Mesh, *others: object) -> tuple[np.ndarray, np.ndarray]:
    return np.full((8, 8, 3), 127, np.uint8), np.zeros((len(mesh.vertices), 2), np.float32)


@pytest.fixture(scope="module")
def traced(tmp_path_factory, todays: Todays) -> Iterator[dict[tuple[str, str], set[str]]]:
    """The names called, by (preset, view), in one of the presets, in another on the next day.

    Of the settings that views have of their own, a run takes every seventh: after two weeks each
    has been taken in both presets.

    Views that need the same island share one, so the calls that build it are counted with the first
    view drawn in it.
    """
    folder = quick_assets(tmp_path_factory.mktemp("quick"))
    found: dict[tuple[str, str], set[str]] = {}
    for preset in todays([*PRESETS], len(PRESETS)):
        given = [{}, *todays(SETTINGS, 7)]
        mine = [v for v in VIEWS.values() if v.preset in (preset, "") and v.settings in given]
        with recording() as recorder, pytest.MonkeyPatch.context() as patch:
            for module in (atlas, refined_atlas):
                patch.setattr(module, "mip_chain", quick_levels)
            patch.setattr(ornate_castle, "light_map", quick_light)
            patch.setattr(weathered_castle, "worn_light_map", quick_light)
            patch.setattr(ornate_castle, "recall", lambda parts, make: make())
            with Offscreen((64, 48), preset, FEW[preset] | MANY, assets=folder) as offscreen:
                for view in sorted(mine, key=lambda v: (str(v.settings), v.shown)):
                    start = len(recorder.calls)
                    offscreen.look(view.name)
                    assert offscreen.scene is not None
                    offscreen.submit()
                    found[preset, view.name] = called(recorder.calls[start:])
                offscreen.draw()
            found[preset, "opening, reading and closing"] = called(recorder.calls)

    yield found


def test_no_view_calls_a_forbidden_function(
    traced: dict[tuple[str, str], set[str]], todays: Todays
) -> None:
    assert len(FORBIDDEN) > 500
    given = [{}, *todays(SETTINGS, 7)]
    presets = {preset for preset, _ in traced} | {""}
    views = [view for view in VIEWS.values() if view.preset in presets]
    wanted = {view.name for view in views if view.settings in given}
    assert wanted and {view for _, view in traced} >= wanted
    assert not {where: names & FORBIDDEN for where, names in traced.items() if names & FORBIDDEN}


def test_every_view_was_really_drawn(traced: dict[tuple[str, str], set[str]]) -> None:
    for where, names in traced.items():
        assert {"glClear", "glLoadIdentity"} <= names, where
        assert names & {"glDrawElements", "glCallList"}, where


@pytest.mark.parametrize("inside_a_list", [False, True])
def test_a_forbidden_call_would_be_found(
    monkeypatch: pytest.MonkeyPatch, plain_folder: Path, inside_a_list: bool
) -> None:
    draw = WaterSurface.draw

    def cheating(self: WaterSurface, frame: object) -> None:
        if inside_a_list:
            name = int(gl.glGenLists(1))
            gl.glNewList(name, gl.GL_COMPILE)
            gl.glUseProgram(0)
            gl.glEndList()
            gl.glCallList(name)
            gl.glDeleteLists(name, 1)
        else:
            gl.glUseProgram(0)
        draw(self, frame)  # type: ignore[arg-type]

    monkeypatch.setattr(WaterSurface, "draw", cheating)
    with recording() as recorder:
        with Offscreen((32, 24), "2006", SMALL, assets=plain_folder, only=("water",)) as offscreen:
            offscreen.look((20.0, 1.0, 20.0, 0.0, 0.0))
            offscreen.draw()
    assert called(recorder.calls) & FORBIDDEN == {"glUseProgram"}
