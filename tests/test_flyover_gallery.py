"""The page of the software fly-over in the gallery: its texts, its pictures and its commands."""

import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from framelens.base.errors import InputError
from framelens.base.texts import LANGUAGES
from landscape.cli import build_parser, main
from landscape.commands.flyover import settings_of
from landscape.flyover.settings import PRESETS, Settings
from landscape.gallery.figures import gallery
from landscape.gallery.flyover_captions import PAIRS, STEPS, VIEWS
from landscape.gallery.flyover_page import half, page, panels, picture
from landscape.gallery.scene_page import PAIR_SIZE, STEP_SIZE, VIEW_SIZE
from landscape.settings.declare import preset, with_settings

KEPT = Path(__file__).resolve().parents[1] / "screenshots" / "flyover"
MOST = 900_000  # bytes, chosen: of all pictures together
SHOTS = [*VIEWS, *STEPS, *(half(pair, on) for pair in PAIRS for on in (0, 1))]


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_committed_page_is_up_to_date(language: str) -> None:
    file = "README.md" if language == "en" else f"README.{language}.md"
    text = (KEPT / file).read_text(encoding="utf-8")
    assert text == page(language), "landscape figures flyover --update"


def test_every_panel_has_its_picture_and_no_other_lies_there() -> None:
    sizes = [VIEW_SIZE] * len(VIEWS) + [STEP_SIZE] * len(STEPS) + [PAIR_SIZE] * 2 * len(PAIRS)
    wanted = dict(zip([shot.name for shot in SHOTS], sizes, strict=True))
    assert [panel.name for panel in panels()] == list(wanted)
    assert {path.stem for path in KEPT.glob("*.webp")} == set(wanted)
    for name, size in wanted.items():
        with Image.open(KEPT / f"{name}.webp") as kept:
            assert kept.size == size, name
    assert sum(path.stat().st_size for path in KEPT.glob("*.webp")) < MOST


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_link_of_the_page_leads_to_a_file(language: str) -> None:
    links = re.findall(r"\]\(([^)\s]+)\)", page(language))
    assert len(links) >= 1 + len(panels())
    for link in links:
        assert (KEPT / link).is_file(), link


def test_the_page_in_french_has_the_commands_of_the_english_one_and_none_of_its_sentences() -> None:
    english, french = page(), page("fr")
    assert re.findall(r"(?m)^    .+$", french) == re.findall(r"(?m)^    .+$", english)
    paragraphs = [set(text.split("\n\n")) for text in (english, french)]
    both = [text for text in set.intersection(*paragraphs) if text[:2] not in ("  ", "##")]
    assert both == []


@pytest.mark.seldom(3, first=2)
def test_each_command_asks_for_the_picture_above_it() -> None:
    for shot, panel in zip(SHOTS, panels(), strict=True):
        options = build_parser().parse_args(shlex.split(panel.command)[1:])
        values = with_settings(preset(Settings(), PRESETS, shot.preset), shot.settings)
        assert settings_of(options) == values, shot.name
        assert (options.file, options.at) == (shot.environment, shot.at)
        assert str(options.out) == f"{shot.name}.png" and f"{shot.name}.webp" in page()


def test_a_command_draws_the_very_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    panel = next(panel for panel in panels() if panel.name == "flyover_hidden_lines_after")
    assert main([*shlex.split(panel.command)[1:], "-q"]) == 0
    shot = next(shot for shot in SHOTS if shot.name == panel.name)
    with Image.open(f"{panel.name}.png") as drawn:
        assert np.array_equal(np.asarray(drawn), picture(shot, PAIR_SIZE))


def test_a_pair_differs_in_its_technique_alone() -> None:
    for pair in PAIRS:
        off, on = (half(pair, each) for each in (0, 1))
        assert off.settings[pair.key] is False and on.settings[pair.key] is True
        assert {**off.settings, pair.key: True} == on.settings


def test_the_fly_over_stands_beside_no_other_name() -> None:
    assert [panel.name for panel in gallery(["flyover"]).panels] == [shot.name for shot in SHOTS]
    with pytest.raises(InputError, match="expected names of one page"):
        gallery(["35", "flyover"])
