"""The title: what it offers, by keys, mouse and gamepad; who meets it, and what it keeps."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from commands import SECONDS, environment, python
from PIL import Image

from framelens.inspector.panel import KEYS
from landscape.cli import parse
from landscape.commands.walk import meets_title
from landscape.files import cache
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.scene.scene import SCENES, find_view, scene
from landscape.walk import last
from landscape.walk.app import Walk
from landscape.walk.last import LastWalk
from landscape.walk.opening import covering
from landscape.walk.recording import Plan, Tick
from landscape.walk.thumbnails import FLIGHT, SIZE, thumbnail
from landscape.walk.title import main_entries, view_entries
from landscape.walk.title_image import Row, title_image
from landscape.walk.walker import Intent

pytestmark = pytest.mark.window


@pytest.fixture
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(cache, "folder", lambda: tmp_path)
    return tmp_path


def test_every_entry_has_its_picture_and_every_view_can_be_walked(own_cache: Path) -> None:
    for entry in main_entries("en"):
        assert entry.picture is not None, entry
    assert [entry.value for entry in main_entries("en")[:3]] == list(SCENES)
    entries = view_entries("fr")
    assert {entry.value for entry in entries} == {
        name for each in SCENES for name in scene(each).main
    }
    for entry in entries:
        assert find_view(entry.value)[1].name == entry.value
        assert entry.picture is not None
        with Image.open(entry.picture) as picture:
            assert picture.size == SIZE
    assert thumbnail(FLIGHT) is not None and thumbnail("../x") is None


def test_the_last_walk_is_offered_as_long_as_it_can_be_read(own_cache: Path) -> None:
    assert last.read() is None and main_entries("en")[0].kind != "last"
    ended = LastWalk("fig35a", Pose(1.0, 2.0, 3.0, 40.0, 5.0))
    last.keep(np.full((90, 1600, 3), 200, np.uint8), ended)
    assert last.read() == ended
    entry = main_entries("en")[0]
    assert entry.kind == "last" and entry.picture == last.picture()
    with Image.open(own_cache / last.PICTURE) as picture:
        assert picture.size == (960, 54)
    assert last.first_picture("fig35b", "island", ended.pose) == last.picture()
    assert last.first_picture("fig35b", "island", Pose(1, 2, 3)) == thumbnail("fig35b")
    assert last.first_picture("R12", "island", Pose(1, 2, 3)) == thumbnail("island")
    for damaged in ("", "{}", "[1]", '{"view": "a", "pose": [1, 2]}', '{"view": 1, "pose": "x"}'):
        (own_cache / last.PLACE).write_text(damaged)
        assert last.read() is None, damaged
    (own_cache / last.PLACE).write_text('{"view": "a", "pose": [1, NaN, 3, 4, 5]}')
    assert last.read() is None


@pytest.mark.parametrize("size", [(1280, 720), (300, 900), (1900, 200), (40, 30), (1, 1)])
def test_the_chosen_row_is_seen_in_every_window(size: tuple[int, int]) -> None:
    rows = [Row(f"a view of something, number {k}", f"view{k}") for k in range(30)]
    for chosen in (0, 17, 29):
        drawn = title_image("Views", rows, chosen, "how to choose", size)
        assert drawn.image.shape == (size[1], size[0], 4)
        assert chosen in drawn.places
        top, end = drawn.places[chosen]
        if size[1] >= 200:
            assert 0 <= top < end <= size[1]
            assert drawn.at(5, (top + end) / 2) == chosen
            assert drawn.at(5, -1) is None and drawn.at(size[0], top) is None


def test_a_sign_says_how_many_rows_a_list_goes_on_for_and_leads_there() -> None:
    size = 1280, 720
    rows = [Row(f"number {k}") for k in range(30)]
    drawn = title_image("Views", rows, 0, "how to choose", size)
    count = len(drawn.places) - 1
    assert 5 < count < 29 and drawn.first == 0

    # Down to the last row that is seen nothing moves; one further, and all move by one.
    last = title_image("Views", rows, count - 1, "how to choose", size, first=0)
    assert last.places == drawn.places
    after = title_image("Views", rows, count, "how to choose", size, first=last.first)
    assert after.first == 1 and set(after.places) == {*range(count + 2)}

    # The signs are at the places of the rows before and behind those that are seen.
    whole = title_image("Views", rows[:count], 0, "how to choose", size)
    assert set(whole.places) == {*range(count)}
    for shown, sign in ((drawn, count), (after, 0), (after, count + 1)):
        top, end = shown.places[sign]
        area = shown.image[top:end, : shown.width, :3].astype(int)
        assert (np.abs(area - KEYS).max(axis=2) < 40).sum() > 20, sign
    top, end = drawn.places[count]
    assert (np.abs(whole.image[top:end, : whole.width, :3].astype(int) - KEYS).max(2) > 40).all()


@pytest.mark.seldom(3, first=1)
def test_a_picture_fills_windows_of_all_sizes(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    Image.new("RGB", (480, 270), (9, 9, 9)).save(path)
    for width in range(90, 1000, 41):
        for height in (90, 123, 457, 799):
            assert covering(path, (width, height)).size == (width, height)


def test_a_picture_that_cannot_be_read_is_none(tmp_path: Path) -> None:
    (tmp_path / "a.jpg").write_bytes(b"\xff\xd8 not a picture")
    rows = [Row("one")]
    plain, damaged = (
        title_image("x", rows, 0, "", (64, 48), behind=path).image
        for path in (None, tmp_path / "a.jpg")
    )
    np.testing.assert_array_equal(plain, damaged)


def test_only_a_walk_without_a_view_and_other_options_meets_the_title() -> None:
    def meets(*options: str) -> bool:
        return meets_title(parse(["walk", *options]))

    for options in ([], ["--fullscreen"], ["--lang", "fr"], ["--fresh", "--mute"]):
        assert meets(*options), options
    for options in (
        *(["fig35a"], ["hall"], ["--frames", "1"], ["--record", "a"], ["--replay", "tour"]),
        *(["--pose", "1,1,1,0,0"], ["--size", "64x48"], ["--preset", "best"], ["--path", "alps"]),
        *(["--set", "fog.enabled=off"], ["--only", "sky"], ["--world", "w"], ["--fps", "0"]),
    ):
        assert not meets(*options), options


TITLE = """
import hashlib, json
import glfw
from framelens.gl.contexts.glfw import GLFWContext
from framelens.gl.framebuffer import read_pixels
from framelens.gl.seam import gl
from landscape.walk import title as module
from landscape.walk.pad import Pad, PadState
from landscape.walk.title import Title

states, ran, seen = [], [], []
module.time.sleep = lambda seconds: None
context = GLFWContext((320, 240), backend="osmesa")

class Watched(Title):
    script = []
    def draw(self):
        super().draw()
        seen.append([hashlib.sha256(read_pixels((320, 240))).hexdigest(), self.index,
                     len(self.entries), self.note])
        if self.script:
            self.script.pop(0)(self)

def key(code):
    def press(title):
        title.key(code)
        title.key(code, glfw.RELEASE)
    return press
def click(number):
    def press(title):
        top, end = title._drawn.places[number]
        title.click(20, (top + end) / 2)
    return press
def pad(button):
    return lambda title: states.append(PadState(frozenset([button])))

title = Watched(context, "en", Pad(lambda: states.pop(0) if states else PadState()),
                lambda words: ran.append(words) or len(ran) - 1)
def choice(*script):
    title.script = list(script)
    entry = title.run()
    return entry and [entry.kind, entry.value]

found = [
    choice(key(glfw.KEY_DOWN), key(glfw.KEY_ENTER)),
    choice(click(2)),
    choice(pad(glfw.GAMEPAD_BUTTON_DPAD_DOWN), pad(glfw.GAMEPAD_BUTTON_A)),
    choice(key(glfw.KEY_END), key(glfw.KEY_UP), key(glfw.KEY_ENTER), key(glfw.KEY_UP),
           key(glfw.KEY_ENTER), key(glfw.KEY_UP), key(glfw.KEY_UP), key(glfw.KEY_SPACE),
           key(glfw.KEY_DOWN),
           key(glfw.KEY_ENTER)),
    choice(key(glfw.KEY_ESCAPE), key(glfw.KEY_ESCAPE)),
    choice(key(glfw.KEY_END), key(glfw.KEY_ENTER)),
]
print(json.dumps([found, ran, seen, int(gl.glGetError())]))
context.release()
"""


def test_keys_mouse_and_gamepad_choose_and_one_key_leaves() -> None:
    done = python(TITLE, env=environment(LANG="C", LANDSCAPE_CACHE=""))
    assert done.status == 0, done.err
    found, ran, seen, error = json.loads(done.out)
    scenes = [["view", name] for name in SCENES]
    flight = ["flyover", "canyon", "--set", "flyover.mode=filled", "--lang", "en"]
    assert found == [scenes[1], scenes[2], scenes[1], ["view", "fig35b"], None, None]
    assert ran == [["lecture", "--lang", "en"], flight]
    assert "the terminal says why" in " ".join(note for *_, note in seen)
    assert error == 0
    assert len({picture for picture, *_ in seen}) > 6, "the pictures are all the same"


WALKS = """
import json, sys
from pathlib import Path
import glfw
from framelens.gl.contexts.glfw import GLFWContext
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.scene.scene import scene
from landscape.walk import last, waiting
from landscape.walk.app import Walk
from landscape.walk.loop import run
from landscape.walk.recording import Plan

waiting.OFTEN = 0.0
told = []
show = waiting.Waiting.show
def noted(self, language):
    told.append(100 * self._steps // self.expected)
    show(self, language)
waiting.Waiting.show = noted

kind = scene("hall")
plan = Plan("hall", kind.settings, "hall", Pose(1.6, None, 2.6), (64, 48), only=("floor",))
context = GLFWContext((64, 48), backend="osmesa")
seen = []
for _ in range(2):
    walk = Walk(plan, Assets(), "osmesa", context=context, titled=True, keeps=True)
    with walk:
        run(walk, frames=2)
        walk.hands.key(glfw.KEY_W, glfw.PRESS)
        run(walk, frames=2)
        walk.hands.key(glfw.KEY_ESCAPE, glfw.PRESS)
        drawn = run(walk, frames=100)
    seen.append([drawn, walk.to_title, bool(glfw.window_should_close(context.window))])
ended = last.read()
print(json.dumps([seen, told, ended.view, ended.pose.z < 2.6, last.picture().is_file()]))
context.release()
"""


@pytest.mark.seldom(13, first=10)
def test_escape_leads_back_to_the_title_and_the_walk_is_kept(tmp_path: Path) -> None:
    done = python(WALKS, env=environment(LANG="C", LANDSCAPE_CACHE=str(tmp_path)))
    assert done.status == 0, done.err
    seen, told, view, moved, picture = json.loads(done.out)
    assert seen == [[0, True, False]] * 2
    assert (view, moved, picture) == ("hall", True, True)
    assert told[0] == 0 and sorted(told[: len(told) // 2]) == told[: len(told) // 2]
    assert len(set(told)) > 3, "no progress is told"


LEAVES = """
import json
import glfw
from framelens.gl.contexts.glfw import GLFWContext
from landscape.elements.element import watched
from landscape.files.assets import Assets
from landscape.scene.scene import find_view
from landscape.walk import waiting
from landscape.walk.hands import Hands
from landscape.walk.session import walk
from landscape.walk.title import TO_TITLE

kind, view = find_view("hall")
listen, show = Hands.listen, waiting.Waiting.show
hands = []
def listened(self, window):
    hands.append((self, window))
    listen(self, window)
def shown(self, language):
    show(self, language)
    leave(*hands[-1])
Hands.listen, waiting.Waiting.show = listened, shown
def stays(hands, window):
    pass
def closes(hands, window):
    glfw.set_window_should_close(window, True)
def escapes(hands, window):
    hands.key(glfw.KEY_ESCAPE, glfw.PRESS)

seen = []
size = 64, 48
for leave in (stays, escapes, closes):
    for titled in (False, True):
        built = []
        context = GLFWContext(size, backend="osmesa") if titled else None
        with watched(built.append):
            status = walk(kind, view, kind.settings, Assets(), size, backend="osmesa", frames=2,
                          only=("floor", "mirror"), context=context, titled=titled, quiet=True)
        seen.append([status == TO_TITLE, len(built) > 1])
        if context is not None:
            context.release()
print(json.dumps(seen))
"""


@pytest.mark.seldom(13, first=2)
def test_who_leaves_while_a_scene_is_built_need_not_wait_until_it_is_there(tmp_path: Path) -> None:
    done = python(LEAVES, env=environment(LANG="C", LANDSCAPE_CACHE=str(tmp_path)))
    assert done.status == 0, done.err
    stays, escapes, closes = [False, True], [False, False], [False, False]
    to_title = [True, False]
    assert json.loads(done.out) == [stays, stays, escapes, to_title, closes, closes]


RESIZED = """
import hashlib, json
import glfw
from framelens.gl.contexts.glfw import GLFWContext
from framelens.gl.framebuffer import read_pixels
from landscape.walk.title import Title

def shown(size, *keys):
    context = GLFWContext((400, 300), backend="osmesa")
    title = Title(context, "en")
    title.draw()
    context.resize(size)
    title.draw()
    for key in keys:
        title.key(key)
    title.draw()
    title.release()
    pixels = read_pixels(size)
    context.release()
    return hashlib.sha256(pixels).hexdigest()

def begun(size, *keys):
    context = GLFWContext(size, backend="osmesa")
    title = Title(context, "en")
    for key in keys:
        title.key(key)
    title.draw()
    title.release()
    pixels = read_pixels(size)
    context.release()
    return hashlib.sha256(pixels).hexdigest()

keys = (), (glfw.KEY_H,), (glfw.KEY_F2,)
print(json.dumps([[look((200, 420), *each) for each in keys] for look in (shown, begun)]))
"""


@pytest.mark.seldom(5, first=4)
def test_keys_and_preferences_in_the_title_fit_a_window_that_was_resized() -> None:
    done = python(RESIZED, env=environment(LANG="C", LANDSCAPE_CACHE=""))
    assert done.status == 0, done.err
    resized, begun = json.loads(done.out)
    assert resized == begun
    assert len(set(begun)) == 3


KEPT = """
import json
import glfw
import numpy as np
from PIL import Image
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.scene.scene import scene
from landscape.walk import last
from landscape.walk.app import Walk
from landscape.walk.loop import run
from landscape.walk.recording import Plan

kind = scene("hall")
plan = Plan("hall", kind.settings, "hall", Pose(1.6, None, 2.6), (320, 240), only=("floor",))
pictures, heard = [], []
for keys in ((), (glfw.KEY_U, glfw.KEY_F2), (glfw.KEY_I,)):
    with Walk(plan, Assets(), "osmesa", keeps=True) as walk:
        run(walk, frames=2)
        for key in keys:
            walk.hands.key(key, glfw.PRESS)
            walk.hands.key(key, glfw.RELEASE)
        run(walk, frames=2)
        heard.append([bool(walk.hearing.lines), walk.wishes.open, walk.inspection.open])
    pictures.append(np.asarray(Image.open(last.picture())))
print(json.dumps([heard, all(bool((pictures[0] == each).all()) for each in pictures)]))
"""


@pytest.mark.seldom(10, first=3)
def test_captions_and_lists_are_not_in_the_picture_of_the_last_walk(tmp_path: Path) -> None:
    done = python(KEPT, env=environment(LANG="C", LANDSCAPE_CACHE=str(tmp_path)))
    assert done.status == 0, done.err
    heard, same = json.loads(done.out)
    assert heard == [[False, False, False], [True, True, False], [False, False, True]]
    assert same


@pytest.mark.parametrize("order", ["preferences", "landmarks"])
@pytest.mark.sweep(4)
def test_after_a_list_a_message_is_shown_as_a_replay_shows_it_which_opens_none(order: str) -> None:
    kind = scene("hall")
    plan = Plan("hall", kind.settings, "hall", Pose(1.6, None, 2.6), (320, 240), only=("floor",))
    pictures = []
    with Walk(plan, Assets(), "osmesa") as walk:
        walk.advance(Tick(0.05, Intent(), (), plan.size, note="a message"))
        for opens in (False, True, True):
            if opens:
                walk.obey(order)
            walk.draw()
            pictures.append(walk.pixels())
    assert (pictures[0] != pictures[1]).any() and (pictures[0] == pictures[2]).all()


IMPORTED = """
import json, sys
import landscape.commands.walk
import landscape.walk.session
from landscape.scene.scene import find_view
find_view("fig35e")
late = "landscape.hall", "landscape.voxel", "framelens.why", "framelens.program"
print(json.dumps([name for name in sys.modules if name.startswith(late)]))
"""


@pytest.mark.seldom(3, first=1)
def test_a_walk_on_the_island_imports_no_other_scene_before_its_first_picture() -> None:
    command = [sys.executable, "-c", IMPORTED]  # a process of its own that has imported nothing
    done = subprocess.run(
        command, env=environment(LANG="C"), capture_output=True, check=True, timeout=SECONDS
    )
    assert json.loads(done.stdout) == []
