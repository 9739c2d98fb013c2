"""The fuzz tool finds what it is to find; `make fuzz` itself is not part of the tests."""

from pathlib import Path

import pytest
from commands import TESTS, python

FUZZ = str(TESTS.parent / "scripts" / "fuzz")

OUTCOMES = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
import worker
from case import Case

cases = {
    "refused": Case(expression="landscape.render('fig99z')"),
    "untyped": Case(expression="1 / 0"),
    "noisy": Case(expression="np.float32(3e38) * np.float32(10)"),
    "small": Case(expression="np.zeros((3, 4, 3), np.uint8)", size=(40, 30)),
    "changed": Case(expression="Path('kept').write_bytes(b'')"),
    "left": Case(expression="Path('.landscape.x').write_bytes(b'')"),
    "half": Case(expression="Path('x.png').write_bytes(b'half a picture')"),
    "usage": Case(args=["settings", "--no-such-option"]),
}
for name, case in cases.items():
    case.add("kept", b"kept")
    folder = Path(sys.argv[2]) / name
    case.prepare(folder)
    status, wrong = worker.run(case, folder)
    print(name, status, "; ".join(wrong)[:40])
"""

EXPECTED = """\
refused 2
untyped 0 untyped error: ZeroDivisionError
noisy 0 printed:
small 0 a picture (3, 4, 3)
changed 0 kept: changed
left 0 .landscape.x: left behind
half 0 x.png: half-written
usage 2"""


@pytest.mark.seldom(3)
def test_every_kind_of_fault_is_found_and_a_clear_error_is_none(tmp_path: Path) -> None:
    done = python(OUTCOMES, FUZZ, str(tmp_path))
    assert (done.status, done.err) == (0, "")
    lines = done.out.splitlines()
    for line, expected in zip(lines, EXPECTED.splitlines(), strict=True):
        assert line.startswith(expected), done.out
    assert {lines[0], lines[-1]} == {"refused 2 ", "usage 2 "}


@pytest.mark.seldom(7, first=6)
def test_inputs_of_every_kind_can_be_made_whatever_they_draw_by_chance() -> None:
    code = """
import sys
sys.path.insert(0, sys.argv[1])
import inputs
for kind in inputs.KINDS:
    for n in range(200):
        inputs.make(f"{kind}-{n}", 7)
"""
    done = python(code, FUZZ)
    assert (done.status, done.err) == (0, "")


@pytest.mark.seldom(5, first=3)
def test_an_input_can_be_made_again_from_the_seed_and_its_name() -> None:
    code = """
import sys
sys.path.insert(0, sys.argv[1])
import inputs
for kind in inputs.KINDS:
    one, same, other = (inputs.make(f"{kind}-{n}", 7).as_json() for n in (3, 3, 4))
    assert one == same and one != other, kind
"""
    done = python(code, FUZZ)
    assert (done.status, done.err) == (0, "")


@pytest.mark.seldom(10, first=9)
def test_no_kind_comes_twice_though_some_bear_the_name_of_a_reader() -> None:
    code = """
import importlib.util
import sys
spec = importlib.util.spec_from_file_location("fuzz", sys.argv[1] + "/__main__.py")
fuzz = importlib.util.module_from_spec(spec)
spec.loader.exec_module(fuzz)
kinds, readers = fuzz.chosen(None)
assert set(kinds) & set(readers)
assert sorted(kinds) == sorted(fuzz.inputs.KINDS) and sorted(readers) == sorted(fuzz.READERS)
assert fuzz.chosen("cache,mesh,cache,svg") == (["cache", "mesh"], ["cache", "svg"])
"""
    done = python(code, FUZZ)
    assert (done.status, done.err) == (0, "")


KILLED = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
import killed
folder = Path(sys.argv[2])
for name in ("world", "recording"):
    work, files = killed.KINDS[name]
    work(folder)
    print(*(file for file in files if (folder / file).stat().st_size))
"""


def test_what_is_killed_at_random_moments_ends_well_if_it_is_not(tmp_path: Path) -> None:
    done = python(KILLED, FUZZ, str(tmp_path))
    assert (done.status, done.out) == (0, "my.world\nwalk.jsonl\n"), done.err
