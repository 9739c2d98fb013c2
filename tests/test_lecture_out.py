"""A lecture that leaves the room: as one page of HTML, and as PDF for slides and a handout."""

import io
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from commands import Shell, landscape, need_library, refused
from PIL import Image

from landscape.course.lecture import page, pdf, texts
from landscape.course.lecture.image import text_image
from landscape.course.lecture.plan import PAPERS, read
from landscape.course.lecture.slides import Row, Slide
from landscape.course.lecture.still import still

LECTURE = """title: Mirrors & more

slide
title: What a mirror is
It shows what is behind it.
- An item
- Another one, <b>plain</b>
note: For me alone.

scale
A mirror is a scaling by -1.
code: SCALES
keys: 1

diagram.png
title: A diagram
It is blue.

fig6a
keys: R
"""
CODE = [
    Row(1, "def draw():", True, False),
    Row(0, "", False, False),
    Row(9, "  # $x #", False, True),
]


class Tags(HTMLParser):
    """The tags of a page, and what they refer to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.images: list[dict[str, str]] = []
        self.references: list[str] = []
        self.open: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = {name: value or "" for name, value in attrs}
        self.references += [found[name] for name in ("src", "href") if name in found]
        if tag == "img":
            self.images.append(found)
        elif tag != "meta":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.fixture
def lecture(tmp_path: Path) -> Path:
    Image.new("RGB", (40, 30), (20, 40, 200)).save(tmp_path / "diagram.png")
    path = tmp_path / "mine.txt"
    path.write_text(LECTURE, encoding="utf-8")
    return path


@pytest.fixture
def slides() -> list[Slide]:
    blue = np.full((30, 40, 3), (20, 40, 200), np.uint8)
    shown = Slide(
        2, "a", "C# & $x$", ["*No* _markup_ @here"], blue, "Blue.", "a.py", CODE, ["Say #"]
    )
    return [
        Slide(1, "slide", "Écran", ["One.", "- An item"], None, "", "", (), ["Ask why."]),
        shown,
        replace(shown, number=3, code=(), notes=()),
    ]


@pytest.mark.seldom(13, first=3)
def test_a_lecture_becomes_one_page_with_its_pictures_code_and_notes(
    lecture: Path, tmp_path: Path
) -> None:
    need_library("OSMesa")
    out, again = tmp_path / "talk.html", tmp_path / "again.html"
    done = landscape("lecture", lecture, "--out", out, "--out", again, "-q")
    assert (done.status, done.out, done.err) == (0, f"{out}\n{again}\n", "")
    assert again.read_bytes() == out.read_bytes()
    text = out.read_text(encoding="utf-8")
    tags = Tags(text)
    assert tags.open == [] and len(tags.images) == 3
    assert all(each.startswith("data:image/webp;base64,") for each in tags.references)
    alts = [image["alt"] for image in tags.images]
    assert alts[1] == "A diagram. It is blue." and all(alts)
    assert "<title>Mirrors &amp; more</title>" in text and "&lt;b&gt;plain&lt;/b&gt;" in text
    assert re.findall(r"<li>(.*?)</li>", text)[0] == "An item"
    assert '<span class="marked"><i>' in text and "For me alone." in text
    assert tags.images[2]["width"] == "1024", "the walk after its key, which shows no message"


def test_the_code_of_a_lesson_is_in_the_users_language_and_the_same_lines_are_marked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "mine.txt"
    path.write_text('stencil_mirror\ncode: mark_disc, "glStencilOp", 104-107\n')
    (step,) = read(path).steps
    (english, matter), plain = texts.program(step), texts.marked(step)
    assert matter == plain and english == step.source()
    monkeypatch.setenv("LANGUAGE", "fr")
    french, moved = texts.program(step)
    calls = [
        [lines[n - 1].split("#")[0].strip() for n in sorted(rows) if "gl" in lines[n - 1]]
        for lines, rows in ((english, matter), (french, moved))
    ]
    assert calls[0] == calls[1] != [] and len(moved) >= len(matter) - 1
    assert list(french) != list(english)


def test_steps_that_stand_still_are_shown_in_the_area(lecture: Path) -> None:
    first, _scale, diagram, _view = read(lecture).steps
    assert first.text == ["It shows what is behind it.", "- An item", "- Another one, <b>plain</b>"]
    shown = still(diagram, (200, 90), 100)
    assert tuple(shown[45, 100]) == (20, 40, 200, 255) and tuple(shown[45, 10]) != (
        20,
        40,
        200,
        255,
    )
    assert (shown[:, 40:160, 2] == 200).all(), "as large as fits, in the middle"
    words = still(first, (400, 300), 340)
    assert (words[:, :, :3].max(axis=2) > 200).any(axis=1).sum() > 30


def test_a_long_text_is_written_in_smaller_letters_than_a_short_one() -> None:
    short, long = (text_image((600, 300), 340, ["A word of it. " * n]) for n in (2, 80))
    tall = [
        np.flatnonzero(np.diff((image[:, :, 0] > 180).any(axis=1).astype(int)))[:2]
        for image in (short, long)
    ]
    assert np.ptp(tall[0]) > np.ptp(tall[1])
    assert not (long[-4:, :, :3] > 180).any(), "all of it fits"


@pytest.mark.parametrize("paper", PAPERS)
def test_a_pdf_is_tagged_has_alternative_texts_and_the_same_bytes_each_time(
    slides: list[Slide], paper: str
) -> None:
    pytest.importorskip("typst")
    pypdf = pytest.importorskip("pypdf")
    data = pdf.as_pdf("Miroirs", slides, "fr", paper)
    assert data == pdf.as_pdf("Miroirs", slides, "fr", paper)

    found = pypdf.PdfReader(io.BytesIO(data))
    root = found.trailer["/Root"]
    assert root["/Lang"] == "fr" and root["/MarkInfo"]["/Marked"] and "/StructTreeRoot" in root
    assert found.metadata.title == "Miroirs"

    alts = [
        str(item.get_object()["/Alt"])
        for item in map(found.get_object, range(1, len(found.xref[0]) + 1))
        if isinstance(item, dict) and "/Alt" in item
    ]
    assert alts == ["Blue.", "Blue."]

    words = "".join(each.extract_text() for each in found.pages)
    assert "C# & $x$" in words and "*No* _markup_ @here" in words and "# $x #" in words

    fonts = {
        str(f.get_object()["/BaseFont"])
        for p in found.pages
        for f in p["/Resources"]["/Font"].values()
    }
    assert all("DejaVu" in name for name in fonts)

    width, height = found.pages[0].mediabox[2:]
    if paper == "a4":
        assert len(found.pages) == 1 and height > width and "Ask why." in words
    else:
        assert len(found.pages) == 3 and round(width / height, 2) == 1.78
        assert "Ask why." not in words, "notes are not for the class"


def test_a_page_is_the_same_each_time_and_closes_what_it_opens(slides: list[Slide]) -> None:
    made = page.as_html("A", slides, "fr")
    assert made == page.as_html("A", slides, "fr")
    assert Tags(made.decode()).open == []
    assert "Notes" in made.decode() and "1 sur 3" in made.decode()


@pytest.mark.seldom(10, first=8)
def test_what_cannot_be_written_is_said_before_anything_is_drawn(
    shell: Shell, lecture: Path, tmp_path: Path
) -> None:
    refused(shell("lecture", lecture, "--out", tmp_path / "a.docx"), "ends in .html or .pdf")
    refused(shell("lecture", lecture, "--out", tmp_path / "a.html", "--paper", "a4"), "--paper")
    refused(shell("lecture", lecture, "--paper", "a4"), "--out FILE.pdf")
    (tmp_path / "bad.png").write_bytes(b"no picture")
    (tmp_path / "bad.txt").write_text("\n\nbad.png\n")
    done = shell("lecture", tmp_path / "bad.txt", "--out", tmp_path / "a.html", "-q")
    refused(done, "line 3 of the lecture", "bad.png")
    assert not list(tmp_path.glob("a.*"))
