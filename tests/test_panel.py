"""The window's texts, in each language, and the panel that shows them."""

import plistlib
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gl_state import changes, snapshot
from PIL import ImageFont
from stage import Stage

from framelens import system
from framelens.base.fonts import font, writable
from framelens.base.texts import choose
from framelens.gl.framebuffer import Framebuffer
from framelens.gl.seam import gl
from framelens.inspector.keys import us_name
from framelens.inspector.panel import Panel, keys_image, line_image, text_size
from landscape.island.fixes import FIXES
from landscape.walk import words
from landscape.walk.keymap import DEFAULT
from landscape.walk.keys import BINDINGS, LETTERS, NAMED_KEYS, SETTINGS

pytestmark = pytest.mark.window


def test_every_text_that_is_shown_exists() -> None:
    shown = (
        {f"help.{binding.action}" for binding in BINDINGS}
        | set(NAMED_KEYS.values())
        | {"help.title", "hint"}
    )
    shown |= {"time.noon", "time.sunset"}
    two = (*(name for name in SETTINGS if name != "time"), "fly", "wireframe")
    shown |= {f"{name}.{way}" for name in two for way in ("on", "off")}
    assert shown <= words.TEXTS.keys()


def test_no_two_actions_share_a_key() -> None:
    positions = [key for binding in BINDINGS if binding.action != "up_down" for key in binding.keys]
    assert len(set(positions)) == len(positions)
    assert len(LETTERS) == sum(bool(binding.letter) for binding in BINDINGS)


@pytest.mark.parametrize(
    ("variables", "language"),
    [
        ({"LANG": "fr_FR.UTF-8"}, "fr"),
        ({"LANG": "fr"}, "fr"),
        ({"LANG": "fr_FR.UTF-8", "LC_ALL": "C"}, "en"),
        ({"LANG": "C", "LANGUAGE": "de:fr_CA:en"}, "fr"),
        ({"LANG": "de_DE.UTF-8"}, "en"),
        ({"LANG": "fr_FR.UTF-8", "LANGUAGE": "en"}, "en"),
    ],
)
def test_the_environment_chooses_the_language(variables: dict[str, str], language: str) -> None:
    assert choose(variables) == language


def test_where_the_environment_names_no_language_the_system_is_asked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for theirs, language in (("fr_CA", "fr"), ("en_US", "en"), ("", "en"), ("de_DE", "en")):
        monkeypatch.setattr(system, "user_language", lambda theirs=theirs: theirs)
        assert choose({}) == choose({"LANG": "", "LANGUAGE": ""}) == language
        assert choose({"LANG": "C"}) == choose({"LANGUAGE": "en"}) == "en"
        assert choose({"LC_ALL": "fr_FR.UTF-8"}) == "fr"


def test_the_system_names_a_language_or_nothing() -> None:
    assert re.fullmatch(r"|[a-z]{2,3}_.+", system.user_language())


@pytest.mark.posix_only("it is asked for the language otherwise")
def test_macos_has_the_language_in_a_file_of_preferences(tmp_path: Path) -> None:
    from framelens.system.posix import _language_in

    preferences = tmp_path / "preferences.plist"
    assert _language_in(preferences) == ""
    for kind in (plistlib.FMT_BINARY, plistlib.FMT_XML):
        preferences.write_bytes(plistlib.dumps({"AppleLocale": "fr_CA"}, fmt=kind))
        assert _language_in(preferences) == "fr_CA"
    for odd in (plistlib.dumps({}), plistlib.dumps(["fr_CA"]), b"<plist>", b"bplist00", b""):
        preferences.write_bytes(odd)
        assert _language_in(preferences) == ""


def test_a_fix_is_named_by_its_title_in_each_language() -> None:
    name, title = FIXES[0].name, FIXES[0].title
    french = "R1  «\u00a0Des nuages qui bougent\u00a0»\u00a0: correction activée"
    assert words.fix_state("fr", name, title, True) == french
    assert words.fix_state("en", name, title, False) == "R1  Clouds that move: off"


ROWS = [("W A S D", "walk (arrows up and down as well)"), ("Page up", "fly, and so on")] * 8


@pytest.mark.parametrize("size", [(640, 480), (1920, 1080), (1600, 900), (320, 240)])
def test_the_list_of_keys_fits_and_its_font_grows_with_the_window(size: tuple[int, int]) -> None:
    image = keys_image("Keys", ROWS, size)
    assert image.shape[1] <= size[0]
    assert image.shape[0] <= size[1]
    if size[1] >= 480:
        assert image.shape[0] > 0.5 * size[1], "the letters are too small for the window"


@pytest.mark.parametrize("size", [(640, 480), (1280, 720), (1920, 1080)])
def test_text_is_larger_on_a_display_of_high_resolution_and_still_fits(
    size: tuple[int, int],
) -> None:
    for dpi in (1.5, 2.0, 3.0):
        assert text_size(size, dpi) >= min(14 * dpi, size[0] // 40)
        message = line_image("fog off", size, dpi)
        assert message.shape[0] >= line_image("fog off", size).shape[0]
        image = keys_image("Keys", ROWS, size, dpi)
        assert image.shape[1] <= size[0] and image.shape[0] <= size[1]
    assert text_size((1280, 720), 2.0) == 28


def key_rows(language: str) -> list[tuple[str, str]]:
    """Return the rows of the help as a US keyboard has them."""
    return [
        (
            DEFAULT.labels(binding.action, language, us_name),
            words.text(language, f"help.{binding.action}"),
        )
        for binding in BINDINGS
    ]


@pytest.mark.parametrize("language", ["en", "fr"])
@pytest.mark.parametrize("size", [(320, 200), (320, 240), (640, 480), (1280, 720)])
def test_all_keys_fit_into_small_windows_too(size: tuple[int, int], language: str) -> None:
    image = keys_image(words.text(language, "help.title"), key_rows(language), size)
    assert image.shape[1] <= size[0] and image.shape[0] <= size[1]


def shown_rows(stage: Stage, size: tuple[int, int], **what: Any) -> np.ndarray:
    """Return whether the panel covers each pixel, (h, w), of a white window of ``size``."""
    target = Framebuffer(size, 0)
    target.bind()
    panel = Panel(words.text("fr", "help.title"), key_rows("fr"))
    with stage.borrowed():
        gl.glViewport(0, 0, *size)
        gl.glClearColor(1.0, 1.0, 1.0, 1.0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        panel.draw(size, **what)
    covered = target.read().min(axis=2) < 255
    panel.release()
    target.release()
    stage.enter()
    return np.asarray(covered)


@pytest.mark.seldom(13, first=4)
@pytest.mark.parametrize("size", [(320, 240), (640, 360), (1280, 720)])
def test_a_message_is_below_the_keys_and_beside_the_list(
    stage: Stage, size: tuple[int, int]
) -> None:
    message = "R2  Flames that face the viewer: on"[: size[0] // 20]
    line = shown_rows(stage, size, message=message)
    keys = shown_rows(stage, size, keys=True)
    assert line.any() and keys.any() and not (line & keys).any()
    wide = int(0.48 * size[0])
    left = "list", lambda: np.full((int(0.94 * size[1]), wide, 4), 200, np.uint8)
    both, alone = (shown_rows(stage, size, left=left, message=m) for m in (message, ""))
    beside = both & ~alone
    assert beside.sum() == line.sum(), "the list hides a part of the message"
    assert np.flatnonzero(beside.any(axis=0)).min() > np.flatnonzero(alone.any(axis=0)).max()


def test_long_texts_shrink_the_font_until_the_list_fits() -> None:
    rows = [
        ("Left Right", "a text as long as some other language may well need to say the same")
    ] * 15
    assert keys_image("Keys", rows, (640, 900)).shape[1] <= 640
    assert (
        line_image("as long as a message in some other language may be", (320, 900)).shape[1] <= 320
    )


def test_in_a_narrow_window_a_long_message_takes_several_lines_of_readable_size() -> None:
    text = "11 frames/s   1,234 lines of 98,765   123,456 pixels"
    image = line_image(text, (300, 900))
    assert image.shape[1] <= 300
    assert image.shape[0] > 2 * line_image("11", (800, 600)).shape[0] * 14 / 17 * 0.8
    assert line_image(text, (1280, 720)).shape[0] == line_image("11", (1280, 720)).shape[0]


def test_the_message_stays_above_what_the_scene_shows_and_a_plate_can_be_opaque(
    stage: Stage,
) -> None:
    def drawn(**how: Any) -> np.ndarray:
        panel = Panel("Keys", [])
        with stage.borrowed():
            gl.glViewport(0, 0, *stage.size)
            gl.glClearColor(1.0, 1.0, 1.0, 1.0)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            panel.draw(stage.size, **how)
            picture = stage.read()
        panel.release()
        return picture

    for covered in (0, 60):
        rows = np.nonzero((drawn(message="fog off", covered=covered) < 200).any(axis=(1, 2)))[0]
        assert stage.size[1] - 1 - rows.max() == stage.size[1] // 24 + covered
    plate = np.full((20, 20, 4), (12, 20, 28, 190), np.uint8)
    for opaque, seen in ((False, False), (True, True)):
        picture = drawn(left=("plate", lambda: plate), opaque=opaque)
        assert bool((picture == (12, 20, 28)).all(axis=2).sum() == 400) is seen


def test_no_window_is_too_small_for_text() -> None:
    for size in ((1, 1), (3, 200), (200, 3)):
        assert keys_image("Keys", ROWS, size).size
        assert line_image("screenshot-0001.png saved", size).size


def test_characters_that_the_font_lacks_are_replaced() -> None:
    own = ImageFont.load_default(16)
    assert writable("Échap, à pied: \uffff", own) == "Echap, a pied: ?"
    assert writable("Esc", font(16)) == "Esc"


def test_the_panel_shows_its_texels_one_to_one(stage: Stage) -> None:
    panel = Panel("Keys", [("A", "b")])
    image = line_image("fog off", stage.size).astype(float)
    height, width = image.shape[:2]
    left, bottom = (stage.size[0] - width) // 2, stage.size[1] - stage.size[1] // 24
    with stage.borrowed():
        gl.glViewport(0, 0, *stage.size)
        gl.glClearColor(1.0, 1.0, 1.0, 1.0)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_FOG)
        # A fog that would swallow all words.
        gl.glFogi(gl.GL_FOG_MODE, gl.GL_LINEAR)
        gl.glFogf(gl.GL_FOG_START, -2.0)
        gl.glFogf(gl.GL_FOG_END, -1.0)
        before = snapshot()
        for opacity in (1.0, 0.5):
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            panel.draw(stage.size, message="fog off", opacity=opacity)
            picture = stage.read()
            alpha = image[..., 3:] / 255 * opacity
            expected = image[..., :3] * alpha + 255 * (1 - alpha)
            shown = picture[bottom - height : bottom, left : left + width]
            assert np.abs(shown - expected).max() <= 2
            assert (picture[: bottom - height] == 255).all()
        panel.draw(stage.size, keys=True)
        assert (stage.read()[stage.size[1] // 2, stage.size[0] // 2] < 255).any()
        assert not changes(before, snapshot())

    panel.release()
    panel.release()
