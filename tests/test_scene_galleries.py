"""The pages of scenes in the gallery, such as screenshots/hall: their texts and pictures."""

import re
from pathlib import Path

import pytest
from PIL import Image

from framelens.base.errors import InputError
from framelens.base.texts import LANGUAGES
from landscape.gallery.figures import gallery, update_pages
from landscape.gallery.scene_captions import STEPS, VIEW_TEXTS
from landscape.gallery.scene_page import PAIR_SIZE, STEP_SIZE, VIEW_SIZE, page, panels
from landscape.scene.scene import scene

KEPT = Path(__file__).resolve().parents[1] / "screenshots"
MOST = {"hall": 2_400_000, "voxel": 1_200_000}  # bytes, chosen: of a scene's pictures together
NAMES = list(VIEW_TEXTS)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("language", LANGUAGES)
def test_the_committed_page_is_up_to_date(name: str, language: str) -> None:
    file = "README.md" if language == "en" else f"README.{language}.md"
    text = (KEPT / name / file).read_text(encoding="utf-8")
    assert text == page(name, language), f"landscape figures {name} --pages"


def test_pages_are_written_without_a_picture(tmp_path: Path) -> None:
    update_pages(["hall"], tmp_path)
    written = sorted(path.name for path in (tmp_path / "hall").iterdir())
    assert written == ["README.fr.md", "README.md"]
    assert (tmp_path / "hall" / "README.md").read_text(encoding="utf-8") == page("hall", "en")


@pytest.mark.parametrize("name", NAMES)
def test_every_panel_has_its_picture_and_no_other_lies_there(name: str) -> None:
    kind, kept = scene(name), KEPT / name
    wanted = {each: VIEW_SIZE for each in VIEW_TEXTS[name]}
    wanted |= {step.name: STEP_SIZE for _, _, steps in STEPS.get(name, ()) for step in steps}
    wanted |= {
        f"{fix.name}_{when}": PAIR_SIZE for fix in kind.fixes for when in ("before", "after")
    }
    assert [panel.name for panel in panels(kind)] == list(wanted)
    assert {path.stem for path in kept.glob("*.webp")} == set(wanted)
    for each, size in wanted.items():
        with Image.open(kept / f"{each}.webp") as picture:
            assert picture.size == size, each
    assert sum(path.stat().st_size for path in kept.glob("*.webp")) < MOST[name]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("language", LANGUAGES)
def test_every_link_of_the_page_leads_to_a_file(name: str, language: str) -> None:
    links = re.findall(r"\]\(([^)\s]+)\)", page(name, language))
    assert len(links) >= 1 + len(panels(scene(name)))
    for link in links:
        assert (KEPT / name / link).is_file(), link


@pytest.mark.parametrize("name", NAMES)
def test_the_page_in_french_has_the_commands_of_the_english_one_and_none_of_its_sentences(
    name: str,
) -> None:
    english, french = page(name), page(name, "fr")
    assert re.findall(r"(?m)^    .+$", french) == re.findall(r"(?m)^    .+$", english)
    paragraphs = [set(text.split("\n\n")) for text in (english, french)]
    both = [text for text in set.intersection(*paragraphs) if text[:2] not in ("  ", "##")]
    assert both == []


@pytest.mark.parametrize("name", STEPS)
def test_a_step_names_a_view_and_elements_and_settings_of_its_scene(name: str) -> None:
    kind = scene(name)
    for _, _, steps in STEPS[name]:
        for step in steps:
            assert step.view in kind.views and kind.only(step.only or None)
            kind.values(None, step.settings)
            assert not kind.notices(kind.views[step.view], None, step.settings, step.only or None)


@pytest.mark.seldom(3, first=1)
def test_each_picture_and_pair_of_a_gallery_is_drawn_by_its_name() -> None:
    for name in ("hall", "voxel", "flyover"):
        whole = gallery([name])
        for panel in whole.panels:
            if panel.name != name:  # the view of the hall that is called so: the name is its page
                assert [each.name for each in gallery([panel.name]).panels] == [panel.name]
                assert gallery([panel.name]).folder == name
    pair = ["mirror_stencil_before", "mirror_stencil_after"]
    assert [each.name for each in gallery(["mirror_stencil"]).panels] == pair
    for wrong in (["hall", "R6"], ["mirror_stencil", "voxel_bay"], ["nosuch"]):
        with pytest.raises(InputError, match="figures"):
            gallery(wrong)
