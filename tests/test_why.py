"""`landscape why`: small programs with one mistake each, and the same programs without it."""

import json
from pathlib import Path

import pytest
from broken_programs import BROKEN, RIGHT
from commands import python

from framelens.base.texts import LANGUAGES
from framelens.why.findings import CAUSES, IDS, WORDS

ROOT = Path(__file__).resolve().parents[1]
CHILD = """
import json, sys
from framelens.program.program_frame import ProgramFrame
from framelens.report.why_report import find
path, frame, pixel = json.loads(sys.argv[1])
found = find(ProgramFrame(path, frame=frame), tuple(pixel) if pixel else None, limit=60.0)
print(json.dumps(found.as_json("en"), default=str))
"""


def why(path: Path, frame: int = 0, pixel: tuple[int, int] | None = None) -> dict:
    """Return what `landscape why --json` prints, by a process of its own."""
    done = python(CHILD, json.dumps([str(path), frame, pixel]))
    assert done.status == 0, done.err[-2000:]
    return json.loads(done.out.splitlines()[-1])


@pytest.mark.sweep(14, first=4)
@pytest.mark.parametrize("name", BROKEN)
def test_the_mistake_is_named_and_its_absence_too(name, tmp_path):
    case = BROKEN[name]
    (tmp_path / "broken.py").write_text(case.source())
    (tmp_path / "mended.py").write_text(case.source(mended=True))
    found = why(tmp_path / "broken.py", case.frame, case.pixel)
    assert found["causes"] and found["causes"][0]["cause"] in case.causes, found
    first = found["causes"][0]
    assert first["pixels"] > 0 and first["source"].startswith("broken.py:")
    assert why(tmp_path / "mended.py", case.frame, case.pixel)["causes"] == []


@pytest.mark.seldom(14, first=9)
@pytest.mark.parametrize("name", RIGHT)
def test_what_is_meant_is_not_blamed(name, tmp_path):
    case = RIGHT[name]
    (tmp_path / "right.py").write_text(case.source())
    found = why(tmp_path / "right.py", case.frame, case.pixel)
    assert found["causes"] == [], found


def test_every_cause_has_its_texts_and_stands_in_the_documentation():
    written = (ROOT / "docs" / "why.md").read_text(encoding="utf-8")
    for cause in IDS:
        assert f"{cause}.mend" in CAUSES
        assert f"| `{cause}` |" in written, cause
    assert "fr" in LANGUAGES and "visible" in WORDS
