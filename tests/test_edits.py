"""Edits: a call with another argument draws what the program does with that constant changed."""

import inspect
import json
from collections.abc import Iterator
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any, NamedTuple

import numpy as np
import pytest
from commands import landscape, refused

from framelens.base.errors import InputError
from framelens.gl import seam
from framelens.gl.seam import edited
from framelens.tape.edit_files import read, write
from framelens.tape.edits import Edits, Located, as_code, edited_value, located_at
from framelens.tape.tape import Tape
from landscape.offscreen import Offscreen

SIZE = (160, 120)


class Case(NamedTuple):
    """A constant in the source, what replaces it, and the edit that must do the same."""

    view: str
    preset: str
    only: tuple[str, ...]
    module: str
    old: str
    new: str
    call: str  # the beginning of the call, as code
    argument: int
    value: Any
    component: int | None = None

    @property
    def element(self) -> str:
        """The element whose call it is; the light belongs to none."""
        return "frame" if self.module == "elements.sun" else self.only[-1]


WATER = ("fig35a", "2006", ("sky", "water"), "elements.water_surface")
MAP = ("fig35f", "2006", ("map",), "elements.map")
FOG = ("fig35a", "2006", ("sky", "fog"), "elements.fog")
IN_THE_FRAME = {
    "fog density": Case(
        *FOG, "gl.GL_FOG_DENSITY, fog.density", "gl.GL_FOG_DENSITY, 0.03", "glFogf(", 1, 0.03
    ),
    "fog mode": Case(*FOG, "gl.GL_EXP2", "gl.GL_EXP", "glFogi(", 1, "GL_EXP"),
    "fog colour": Case(
        *FOG,
        "[*fog.color, 1.0]",
        "[0.9, 0.25, 0.5, 1.0]",
        "glFogfv(",
        1,
        [0.9, 0.25, 0.5, 1.0],
    ),
    "blend function of the water": Case(
        *WATER, "gl.GL_ONE_MINUS_SRC_ALPHA", "gl.GL_ONE", "glBlendFunc(", 1, "GL_ONE"
    ),
    "alpha of the water": Case(
        *WATER,
        "gl.glColor4f(*water.color)",
        "gl.glColor4f(*water.color[:3], 0.25)",
        "glColor4f(",
        3,
        0.25,
    ),
    "clip plane": Case(
        "fig35a",
        "2006",
        ("sky", "ground"),
        "elements.ground",
        "0.0, 1.0, 0.0, -level",
        "0.0, 1.0, 0.0, -1.5",
        "glClipPlane(",
        1,
        -1.5,
        3,
    ),
    "alpha test": Case(
        "fig35c",
        "2006",
        ("ground", "trees"),
        "elements.transparent_elements",
        "gl.glAlphaFunc(gl.GL_GREATER, CLEAR)",
        "gl.glAlphaFunc(gl.GL_GREATER, 0.8)",
        "glAlphaFunc(",
        1,
        0.8,
    ),
    "point size of the map": Case(*MAP, "5.0 * frame.detail.scale", "9.0", "glPointSize(", 0, 9.0),
    "viewport of the map": Case(
        *MAP,
        "gl.glViewport(0, 3 * height // 4, width // 4, height // 4)",
        "gl.glViewport(0, 3 * height // 4, 80, height // 4)",
        "glViewport(0, 90",
        2,
        80,
    ),
    "light": Case(
        "fig35a",
        "2006",
        ("sky", "water"),
        "elements.sun",
        "gl.GL_DIFFUSE, np.array([*sun.diffuse, 1.0]",
        "gl.GL_DIFFUSE, np.array([*sun.diffuse[:2], 0.0, 1.0]",
        "glLightfv(GL_LIGHT0, GL_DIFFUSE",
        2,
        0.0,
        2,
    ),
}
IN_LISTS = {
    "alpha of the map": Case(
        *MAP,
        "gl.glColor4f(1.0, 1.0, 1.0, alpha)",
        "gl.glColor4f(1.0, 1.0, 1.0, 0.25)",
        "glColor4f(1, 1, 1, 0.75)",
        3,
        0.25,
    ),
    "blend function of the map": Case(
        *MAP, "gl.GL_ONE_MINUS_SRC_ALPHA", "gl.GL_ONE", "glBlendFunc(", 1, "GL_ONE"
    ),
    "scale of the ground's colours": Case(
        "fig35a",
        "2006",
        ("ground",),
        "elements.ground",
        "gl.GL_RGB_SCALE, 2.0",
        "gl.GL_RGB_SCALE, 4.0",
        "glTexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, 2",
        2,
        4.0,
    ),
    "place of a torch": Case(
        "fig35f",
        "2006",
        ("castle",),
        "elements.castle",
        "gl.glTranslatef(x, y, FLAME_Z)\n                    draw_mesh(mesh)",
        "gl.glTranslatef(0.5 if (x, y) == (TORCHES[0], TORCH_BASE) else x, y, FLAME_Z)\n"
        "                    draw_mesh(mesh)",
        "glTranslatef(0.27, 0.1,",
        0,
        0.5,
    ),
    "how the ground's textures are combined": Case(
        "fig35a",
        "2006",
        ("ground",),
        "elements.ground",
        "gl.GL_COMBINE_RGB, gl.GL_MODULATE",
        "gl.GL_COMBINE_RGB, gl.GL_ADD",
        "glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB",
        2,
        "GL_ADD",
    ),
    "colour of the sky": Case(
        "fig35a",
        "2006",
        ("sky",),
        "elements.sky_box",
        "gl.glColor4f(1.0, 1.0, 1.0, 1.0)",
        "gl.glColor4f(1.0, 0.5, 1.0, 1.0)",
        "glColor4f(",
        1,
        0.5,
    ),
}
CASES = {**IN_THE_FRAME, **IN_LISTS}


def opened(case: Case, edits: Edits | None = None) -> Offscreen:
    few = {"ground.texture_size": 256}
    return Offscreen(SIZE, case.preset, few, only=case.only, samples=0, edits=edits)


def picture(case: Case, edits: Edits | None = None) -> np.ndarray:
    with opened(case, edits) as offscreen:
        offscreen.look(case.view)
        return offscreen.draw()


def calls_like(tape: Tape, case: Case) -> Iterator[Located]:
    """Yield how the calls of a case are found again, those of a list once."""
    found = set()
    for call in tape.frame:
        places = [(str(call.number), call)]
        places += [(f"{call.number}.{k}", inner) for k, inner in enumerate(call.listed)]
        for place, each in places:
            if each.element == case.element and as_code(each).startswith(case.call):
                located = located_at(tape.calls, tape.begin, place)
                if (located.key, located.occurrence) not in found:
                    found.add((located.key, located.occurrence))
                    yield located


def functions(module: ModuleType | dict[str, Any]) -> dict[str, Any]:
    """Return a module's functions and methods by their qualified names."""
    names = module if isinstance(module, dict) else vars(module)
    found = {}
    for value in list(names.values()):
        for each in vars(value).values() if isinstance(value, type) else [value]:
            plain = inspect.unwrap(each) if callable(each) else each
            if isinstance(plain, FunctionType):
                found[plain.__qualname__] = plain
    return found


def change_source(patch: pytest.MonkeyPatch, name: str, old: str, new: str) -> None:
    """Run a module's functions as if its source had ``new`` instead of ``old``."""
    module = import_module(f"landscape.{name}")
    source = inspect.getsource(module)
    assert source.count(old) == 1, f"{old!r} in {name}"
    names = {"__name__": module.__name__}
    exec(compile(source.replace(old, new), module.__file__ or "", "exec"), names)
    changed = functions(names)
    for each, function in functions(module).items():
        if function.__module__ == module.__name__:
            patch.setattr(function, "__code__", changed[each].__code__)


@pytest.mark.parametrize("name", CASES)
@pytest.mark.sweep(8)
def test_an_edit_gives_the_bytes_of_the_program_with_that_constant_changed(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = CASES[name]
    with opened(case) as offscreen, offscreen.taped(case.view) as tape:
        found = list(calls_like(tape, case))
    assert len(found) == 1 and (found[0].key.list is not None) == (name in IN_LISTS)
    edit = found[0].edit(case.argument, case.value, case.component)
    before, after = picture(case), picture(case, Edits([edit]))
    change_source(monkeypatch, case.module, case.old, case.new)
    changed = picture(case)
    assert (before != changed).any(), "the constant shows"
    assert np.array_equal(after, changed)


@pytest.fixture(scope="module")
def density() -> Located:
    case = CASES["fog density"]
    with opened(case) as offscreen, offscreen.taped(case.view) as tape:
        (found,) = calls_like(tape, case)
    return found


def test_a_file_brings_the_same_edits_back(density: Located, tmp_path: Path) -> None:
    case = CASES["alpha of the map"]
    with opened(case) as offscreen, offscreen.taped(case.view) as tape:
        (inside,) = calls_like(tape, case)
    edits = [density.edit(1, 0.5), density.without(), inside.edit(3, 0.5), inside.edit(0, [1], 2)]
    write(edits, tmp_path / "edits.json")
    assert read(tmp_path / "edits.json") == edits


@pytest.mark.seldom(3, first=2)
def test_the_same_call_left_out_draws_as_without_it(density: Located) -> None:
    case = CASES["fog density"]
    edits = Edits([density.without()])
    with opened(case, edits) as offscreen, offscreen.taped(case.view) as tape:
        skipped = [call for call in tape.frame if call.skipped]
    assert [call.name for call in skipped] == ["glFogf"] and edits.missed() == []
    # Without it the density is what it is at first: 1.
    assert np.array_equal(picture(case, edits), picture(case, Edits([density.edit(1, 1.0)])))


def test_an_edit_survives_calls_that_come_before_its_own(
    density: Located, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = CASES["fog density"]
    wanted = picture(case, Edits([density.edit(1, 0.4)]))
    change_source(
        monkeypatch,
        case.module,
        "    gl.glEnable(gl.GL_FOG)",
        "    gl.glHint(gl.GL_FOG_HINT, gl.GL_NICEST); gl.glFogf(gl.GL_FOG_START, 1.0); "
        "gl.glEnable(gl.GL_FOG)",
    )
    edits = Edits([density.edit(1, 0.4)])
    assert np.array_equal(picture(case, edits), wanted) and edits.missed() == []


def test_an_edit_whose_line_is_gone_from_the_file_is_found_by_its_function(
    density: Located, tmp_path: Path
) -> None:
    case = CASES["fog density"]
    path = tmp_path / "edits.json"
    write([density.edit(1, 0.4)], path)
    entries = json.loads(path.read_text())
    entries["edits"][0]["call"]["text"] = "gl.glFogf(gl.GL_FOG_DENSITY, an_older_name)"
    path.write_text(json.dumps(entries))
    edits = Edits(read(path))
    assert np.array_equal(picture(case, edits), picture(case, Edits([density.edit(1, 0.4)])))
    assert edits.missed() == []


@pytest.mark.seldom(10, first=5)
def test_edits_that_find_no_call_are_told_by_the_commands(density: Located, tmp_path: Path) -> None:
    path = tmp_path / "edits.json"
    write([density.edit(1, 0.4)], path)
    small = ("--preset", "2006", "--size", "160x120")
    done = landscape("trace", "fig35a", *small, "--only", "sky", "--edits", path)
    assert done.status == 0 and "edit 1: no call glFogf(GL_FOG_DENSITY, 0.12) of fog" in done.err
    done = landscape("trace", "fig35a", *small, "--only", "sky,fog", "--edits", path)
    assert done.status == 0 and done.err == "" and "glFogf(GL_FOG_DENSITY, 0.4)" in done.out


@pytest.mark.seldom(3, first=1)
def test_a_file_is_read_before_a_platform_is_chosen(tmp_path: Path) -> None:
    path, out = tmp_path / "edits.json", tmp_path / "a.png"
    text = '{"version": 1, "edits": [{"call": {CALL}, "argument": 1, "value": "GL_EXP"}]}'
    path.write_text(text.replace("{CALL}", CALL))
    words = ("render", "fig35a", "--preset", "2006", "--size", "64x48", "--only", "sky,fog")
    done = landscape(*words, "--edits", path, "--out", out)
    assert done.status == 0 and out.exists(), done.err


BAD = {
    "not JSON": "{",
    "another file": '{"version": 1}',
    "another version": '{"version": 9, "edits": []}',
    "a version that is no number": '{"version": true, "edits": []}',
    "a truth value in a vector": '{"version": 1, "edits": [{"call": {CALL}, "argument": 1, '
    '"value": [true, 0, 0, 1]}]}',
    "no call": '{"version": 1, "edits": [{"argument": 0, "value": 1}]}',
    "no value": '{"version": 1, "edits": [{"call": {CALL}, "argument": 0}]}',
    "an unknown enumerant": '{"version": 1, "edits": [{"call": {CALL}, "argument": 0, '
    '"value": "GL_NO_SUCH"}]}',
    "a value of no kind": '{"version": 1, "edits": [{"call": {CALL}, "argument": 0, '
    '"value": {"a": 1}}]}',
    "a negative argument": '{"version": 1, "edits": [{"call": {CALL}, "argument": -1, '
    '"value": 1}]}',
    "a call that must be made": '{"version": 1, "edits": [{"call": {"name": "glGenLists", '
    '"element": "", "pass": "", "file": "", "function": "", "text": ""}, "skip": true}]}',
    "no function of OpenGL": '{"version": 1, "edits": [{"call": {"name": "os.system", '
    '"element": "", "pass": "", "file": "", "function": "", "text": ""}, "skip": true}]}',
}
CALL = (
    '{"name": "glFogf", "element": "fog", "pass": "main", "file": "landscape/elements/fog.py", '
    '"function": "enable", "text": "x"}'
)


@pytest.mark.parametrize("text", BAD.values(), ids=BAD)
def test_a_bad_file_of_edits_is_refused_in_one_line_that_names_it(
    text: str, tmp_path: Path
) -> None:
    path = tmp_path / "edits.json"
    path.write_text(text.replace("{CALL}", CALL))
    with pytest.raises(InputError, match=r"edits\.json: ") as caught:
        read(path)
    assert "\n" not in str(caught.value)


MISFITS = {
    "text for a number": (0, "glFogf(", 1, [1, 2, 3], None),
    "a component that is not there": (0, "glFogfv(", 1, 0.5, 4),
    "an argument that is not there": (0, "glFogf(", 7, 0.5, None),
    "more vertices than there are": (1, "glDrawElements(", 1, 1 << 30, None),
    "another type of index": (1, "glDrawElements(", 2, "GL_UNSIGNED_BYTE", None),
    "half a texture": (1, "glBindTexture(", 1, 0.5, None),
}


@pytest.mark.sweep(3)
@pytest.mark.parametrize("name", MISFITS)
def test_a_value_that_does_not_fit_its_argument_is_refused_in_one_line(
    tmp_path: Path, name: str
) -> None:
    which, call, argument, value, component = MISFITS[name]
    case = (CASES["fog density"], CASES["clip plane"])[which]._replace(call=call)
    with opened(case) as offscreen, offscreen.taped(case.view) as tape:
        found = next(calls_like(tape, case))
    write([found.edit(argument, value, component)], path := tmp_path / "e.json")
    with opened(case, Edits(read(path))) as offscreen:
        with pytest.raises(InputError, match=f"e.json: edit 1: {found.call.name}, argument"):
            offscreen.look(case.view)
            offscreen.draw()


def test_the_command_refuses_a_missing_file() -> None:
    done = landscape("trace", "fig35a", "--edits", "no-such-file.json")
    refused(done, "no-such-file.json")


def test_without_edits_nothing_is_wrapped() -> None:
    with edited(None):
        assert seam.gl.__dict__ is seam.seam.plain


@pytest.mark.parametrize("former", [1.0, 1, True])
def test_a_number_keeps_the_kind_of_argument_it_replaces(former: Any) -> None:
    value = edited_value(former, 0)
    assert value == 0 and isinstance(value, float) == isinstance(former, float)


def test_the_source_that_a_file_names_is_read_within_bounds(
    density: Located, tmp_path: Path
) -> None:
    path = tmp_path / "edits.json"
    write([density.edit(1, 0.5)], path)
    entries = json.loads(path.read_text())
    entries["edits"][0]["call"]["file"] = "/dev/zero"
    path.write_text(json.dumps(entries))
    assert [edit.key.file for edit in read(path)] == ["zero"]


def test_an_enumerant_given_as_a_number_has_its_name_in_the_code_of_a_call() -> None:
    site = seam.Site("here.py", 1, "draw", "here.py")

    def code(name: str, *args: Any) -> str:
        return as_code(seam.Call(name, args, ("frame",), "main", site))

    radial = np.array([0x855B], np.float32)
    assert code("glFogfv", 0x855A, radial) == (
        "glFogfv(GL_FOG_DISTANCE_MODE_NV, [GL_EYE_RADIAL_NV])"
    )
    assert code("glBegin", 7) == "glBegin(GL_QUADS)"
    assert code("glFogf", 0x0B62, 0.12) == "glFogf(GL_FOG_DENSITY, 0.12)"
    assert code("glBindTexture", 0x0DE1, 5) == "glBindTexture(GL_TEXTURE_2D, 5)"


def test_an_edit_of_a_module_that_has_moved_since_finds_its_call(tmp_path: Path) -> None:
    call = {
        "name": "glFogf",
        "element": "fog",
        "pass": "main",
        "file": "landscape/former_room/fog.py",
        "function": "enable",
        "text": "gl.glFogf(gl.GL_FOG_DENSITY, fog.density)",
        "select": ["GL_FOG_DENSITY"],
        "occurrence": 0,
    }
    path = tmp_path / "edits.json"
    entry = {"call": call, "argument": 1, "value": 0.3}
    path.write_text(json.dumps({"version": 1, "edits": [entry]}))

    (edit,) = read(path)
    assert edit.key.finds(replace(edit.key, file="landscape/elements/fog.py"))
    assert not edit.key.finds(replace(edit.key, file="landscape/elements/sun.py"))
