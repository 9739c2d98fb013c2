"""The gallery: the panels, captions and commands of every figure and every fix, and the page."""

import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from commands import landscape
from folded import each
from PIL import Image

from framelens.base.errors import InputError
from landscape.elements.settings import Settings, preset
from landscape.gallery.compare import agree
from landscape.gallery.figures import check, make
from landscape.gallery.page import anchor, page
from landscape.gallery.panels import BACKGROUND, SIZE, named_panels, on_grey, panels
from landscape.gallery.view_captions import VIEW_PANELS
from landscape.island.fixes import FIXES
from landscape.island.views import VIEWS
from landscape.scene.scene import SCENES, scene
from landscape.settings import declare
from landscape.settings.declare import get, with_settings

ROOT = Path(__file__).resolve().parents[1]
KEPT = ROOT / "screenshots"


def names(*wanted: str) -> list[str]:
    return [panel.name for panel in named_panels(list(wanted))]


def test_there_are_87_panels_of_the_report_and_two_for_each_fix() -> None:
    every = [panel.name for panel in panels()]
    assert len(set(every)) == len(every) == 87 + 2 * len(FIXES)
    assert every[:3] == ["fig1a", "fig2a", "fig2b"] and every[86] == "fig43a"
    assert {path.stem for path in KEPT.glob("*.png")} == set(every)


def test_every_named_view_has_a_caption() -> None:
    assert set(VIEW_PANELS) == {name for name in VIEWS if name.startswith("fig")}


def test_panels_are_chosen_by_figure_panel_or_fix() -> None:
    assert names("4") == names("fig4") == ["fig4a", "fig4b", "fig4c"]
    assert names("fig4b") == ["fig4b"]
    assert names("R1") == ["R1_before", "R1_after"]
    assert names("R6") == names("R6a", "R6b") and len(names("R6")) == 4
    assert names("best2", "4", "fig4a") == ["best2_before", "best2_after", *names("4")]
    assert names() == [panel.name for panel in panels()]
    for wrong in ("99", "fig4z", "R", "R20", "best", ""):
        with pytest.raises(InputError, match=r"expected a figure"):
            names(wrong)


@each("fix", FIXES, ids=lambda fix: fix.name)
def test_every_pair_differs_in_settings_and_2006_has_those_of_its_before(fix) -> None:
    assert fix.off.keys() <= fix.on.keys() and dict(fix.off) != dict(fix.on)
    before = preset("2006")
    for key, value in fix.off.items():
        if fix.name != "R18":
            assert get(before, key) == value, key
    assert with_settings(before, fix.settings(True)) != with_settings(before, fix.settings(False))


@each("fix", FIXES, ids=lambda fix: fix.name)
def test_every_pair_uses_current_setting_names(fix) -> None:
    for after in (False, True):
        assert fix.settings(after).keys() <= declare.fields(Settings).keys()


def test_there_is_a_pair_for_each_improvement_of_the_report() -> None:
    assert {f"R{k}" for k in range(1, 20)} == {
        fix.name.rstrip("ab") for fix in FIXES if fix.name.startswith("R")
    }


@each("fix", FIXES, ids=lambda fix: fix.name)
def test_a_printed_command_has_the_settings_of_its_picture(fix) -> None:
    for panel, after in zip(named_panels([fix.name]), (False, True), strict=True):
        words = shlex.split(panel.command)
        given = [word for option, word in zip(words, words[1:], strict=False) if option == "--set"]
        changes = dict(word.split("=") for word in given)
        assert with_settings(Settings(), changes) == with_settings(Settings(), fix.settings(after))


@pytest.mark.seldom(13, first=9)
def test_a_printed_command_draws_the_committed_picture(tmp_path: Path) -> None:
    for panel in named_panels(["fig5a", "R14_after", "R15_after"]):
        program, *words = shlex.split(panel.command)
        done = landscape(*words, "--out", tmp_path / "picture.png", "-q")
        assert (program, done.status, done.err) == ("landscape", 0, "")
        assert "--preset 2006" in panel.command
        kept, drawn = (
            np.asarray(Image.open(path).convert("RGB"))
            for path in (KEPT / f"{panel.name}.png", tmp_path / "picture.png")
        )
        assert agree(kept, drawn, same_renderer=False), panel.name


def test_a_pose_s_height_is_a_number_or_the_word_ground() -> None:
    commands = {panel.name: panel.command for panel in panels()}
    assert "--pose=20,ground,22,120,35 " in commands["R1_before"]
    assert "--pose=24.3,2.5,25.5,0,-82 " in commands["R4_before"]
    assert "--pose=20,ground,28,250,0 " in commands["R13_after"]


def test_the_committed_page_is_up_to_date() -> None:
    for language, name in (("en", "README.md"), ("fr", "README.fr.md")):
        text = (KEPT / name).read_text(encoding="utf-8")
        assert text == page(language), "landscape figures --update"


def test_the_page_in_french_has_the_pictures_and_commands_of_the_english_one() -> None:
    english, french = page(), page("fr")
    for pattern in (r"\]\((\w+\.png)\)", r"(?m)^    .+$"):
        assert re.findall(pattern, french) == re.findall(pattern, english)
    paragraphs = [set(text.split("\n\n")) for text in (english, french)]
    both = [text for text in set.intersection(*paragraphs) if text[:4] not in ("    ", "### ")]
    assert both == []


@pytest.mark.parametrize(
    "path",
    [
        "screenshots/README.md",
        "screenshots/README.fr.md",
        "README.md",
        "README.fr.md",
        "CHANGELOG.md",
    ],
)
def test_every_link_of_a_page_leads_somewhere(path: str) -> None:
    text = (ROOT / path).read_text(encoding="utf-8")
    links = re.findall(r"\]\(([^)\s]+)\)", text)
    assert links
    for link in links:
        if link.startswith("http"):
            continue
        file, _, part = link.partition("#")
        target = (ROOT / path).parent / file if file else ROOT / path
        assert target.exists(), link
        if part:
            headings = re.findall(r"^#+ (.*)$", target.read_text(encoding="utf-8"), re.MULTILINE)
            assert part in map(anchor, headings), link


def test_every_file_and_setting_a_document_names_exists() -> None:
    groups = {key.split(".")[0] for key in declare.fields(Settings)}
    for path in ("README.md", "docs/performance.md", "CHANGELOG.md"):
        text = (ROOT / path).read_text(encoding="utf-8")
        # The changelog also says what became of old names.
        former = Settings.RENAMED if path == "CHANGELOG.md" else {}
        # Scenes share the names of some groups, such as mist.
        every = (declare.fields(type(scene(name).settings)) for name in SCENES)
        known = {*former, *(key for fields in every for key in fields)}
        for group, name in re.findall(r"(?:`|--set )([a-z]+)\.([a-z_0-9]+)\b", text):
            if group in groups and name not in ("py", "png", "ply"):
                assert f"{group}.{name}" in known, f"{path}: {group}.{name}"
        for name in re.findall(r"\b[\w/]+/\w+\.py\b", text):
            assert any((base / name).exists() for base in (ROOT, ROOT / "landscape")), name


def test_a_small_image_is_enlarged_and_centred_on_grey() -> None:
    image = np.zeros((10, 20, 4), np.uint8)
    image[:, :10] = (255, 0, 0, 255)
    picture = on_grey(image)
    assert picture.shape == (SIZE[1], SIZE[0], 3)
    red = (picture == (255, 0, 0)).all(axis=2)
    assert red.sum() == 100 * 15 * 15 and red[150, 199] and not red[150, 200]
    assert (picture[~red] == BACKGROUND).all()


@pytest.mark.seldom(3, first=1)
def test_check_passes_what_was_just_made_and_shows_what_differs(tmp_path: Path) -> None:
    kept, out = tmp_path / "kept", tmp_path / "out"
    assert make(["fig23a"], kept, {}, quiet=True) == [kept / "fig23a.png"]
    assert check(["fig23a"], kept, out, {}, quiet=True) == 0 and not out.exists()
    make(["fig24a"], kept, {}, quiet=True)
    (kept / "fig24a.png").replace(kept / "fig23a.png")
    assert check(["fig23a", "fig23b"], kept, out, {}, quiet=True) == 1
    assert {path.name for path in out.iterdir()} == {
        "fig23a_expected.png",
        "fig23a_actual.png",
        "fig23a_difference.png",
        "fig23b_actual.png",
    }
