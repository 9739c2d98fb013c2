"""Text in pictures: the shipped fonts alone, and the same pixels on every system."""

import json
from pathlib import Path

import polib
import pytest
from commands import environment, python

from framelens.base.fonts import font, monospaced, writable
from framelens.base.packages import FRAMELENS, PACKAGES
from framelens.base.texts import typeset

FRENCH = "Éclat à l'œil × 12 : « été »"
# Prints the hash of a picture of a text in each face; without the library by which Pillow may lay
# out texts, where the first argument says so.
PICTURES = f"""
import hashlib, json, sys
from PIL import Image, ImageDraw, ImageFont
ImageFont.core.HAVE_RAQM = ImageFont.core.HAVE_RAQM and sys.argv[1] == "as it is"
from framelens.base.fonts import font, monospaced
hashes = []
for face in (font(14), font(14, bold=True), monospaced(14)):
    picture = Image.new("L", (500, 30))
    ImageDraw.Draw(picture).text((4, 4), {FRENCH!r} + " AVATAR To", fill=255, font=face)
    hashes.append(hashlib.sha256(picture.tobytes()).hexdigest())
print(json.dumps(hashes))
"""


def test_text_is_the_same_without_system_fonts_and_without_a_layout_library(tmp_path: Path) -> None:
    bare = environment(XDG_DATA_DIRS=str(tmp_path), XDG_DATA_HOME=str(tmp_path))
    here = json.loads(python(PICTURES, "as it is").out)
    assert len(set(here)) == 3, "three faces"
    assert json.loads(python(PICTURES, "none", env=bare).out) == here


def test_french_keeps_its_letters_in_every_face() -> None:
    for face in (font(14), font(14, bold=True), monospaced(14)):
        assert writable(FRENCH, face) == FRENCH


@pytest.mark.seldom(3)
def test_every_character_of_the_translations_can_be_written() -> None:
    texts = {
        character
        for package in PACKAGES
        for path in package.locale.rglob("*.po")
        for entry in polib.pofile(str(path), encoding="utf-8")
        for character in entry.msgid + typeset(entry.msgstr)
    }
    printed = "".join(sorted(texts - {"\n", "\t"}))
    assert len(printed) > 100
    assert writable(printed, font(14)) == printed


def test_all_letters_of_code_are_equally_wide() -> None:
    face = monospaced(15)
    assert len({face.getlength(letter) for letter in "iWé.0_"}) == 1
    assert font(15).getlength("i") < font(15).getlength("W")


def test_the_fonts_come_with_their_licence() -> None:
    folder = FRAMELENS.folder / "fonts"
    assert "Bitstream Vera" in (folder / "LICENSE").read_text(encoding="utf-8")
    assert {Path(face.path).parent for face in (font(9), font(9, True), monospaced(9))} == {folder}
