"""The hall's page of the gallery, screenshots/hall: its text and its pictures."""

import re
from pathlib import Path

import pytest
from PIL import Image

from landscape.gallery.scene_page import PAIR_SIZE, VIEW_SIZE, page, panels
from landscape.languages import LANGUAGES
from landscape.scene import scene

KEPT = Path(__file__).resolve().parents[1] / "screenshots" / "hall"


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_committed_page_is_up_to_date(language: str) -> None:
    name = "README.md" if language == "en" else f"README.{language}.md"
    text = (KEPT / name).read_text(encoding="utf-8")
    assert text == page("hall", language), "landscape figures hall --update"


def test_every_view_and_every_half_of_a_pair_has_its_picture_and_no_other_lies_there() -> None:
    hall = scene("hall")
    names = {panel.name for panel in panels(hall)}
    assert {path.stem for path in KEPT.glob("*.webp")} == names
    pairs = {f"{fix.name}_{when}" for fix in hall.fixes for when in ("before", "after")}
    for name in sorted(names):
        with Image.open(KEPT / f"{name}.webp") as picture:
            assert picture.size == (PAIR_SIZE if name in pairs else VIEW_SIZE), name


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_link_of_the_page_leads_to_a_file(language: str) -> None:
    links = re.findall(r"\]\(([^)\s]+)\)", page("hall", language))
    assert len(links) == 1 + len(panels(scene("hall")))
    for link in links:
        assert (KEPT / link).is_file(), link


def test_the_page_in_french_has_the_commands_of_the_english_one_and_none_of_its_sentences() -> None:
    english, french = page("hall"), page("hall", "fr")
    assert re.findall(r"(?m)^    .+$", french) == re.findall(r"(?m)^    .+$", english)
    paragraphs = [set(text.split("\n\n")) for text in (english, french)]
    both = [text for text in set.intersection(*paragraphs) if text[:2] not in ("  ", "##")]
    assert both == []
