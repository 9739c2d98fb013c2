"""The window of a walk opens before the scene is read, and shows a picture at once."""

import json
import subprocess
import sys

import pytest
from commands import environment, python

from landscape.cli import parse
from landscape.commands.walk import opens_at_once

pytestmark = pytest.mark.window


def test_a_window_opens_at_once_where_nothing_can_be_found_wrong_later() -> None:
    def opens(*options: str) -> bool:
        return opens_at_once(parse(["walk", *options]))

    for options in ([], ["--fullscreen"], ["--size", "64x48"], ["--frames", "9", "--fps", "0"]):
        assert opens("fig35a", *options), options
    assert opens("hall") and opens("voxel_bay", "--mute", "--lang", "fr")
    for options in (
        *([], ["fig99z"], ["R12"], ["fig35a", "--pose", "1,1,1,0,0"], ["hall", "--kt", "1"]),
        *(["fig35a", "--set", "no.such=1"], ["fig35a", "--backend", "egl"], ["--replay", "tour"]),
        *(["fig35a", "--world", "w"], ["fig35a", "--record", "a"], ["fig35a", "--path", "alps"]),
        *(["fig35a", "--assets", "none"], ["fig35a", "--only", "sky"], ["fig35a", "--edits", "e"]),
    ):
        assert not opens(*options), options


def test_what_shows_the_first_picture_reads_no_scene_and_no_inspector() -> None:
    code = """
import sys
from landscape.cli import parse
from landscape.commands.walk import opens_at_once
assert opens_at_once(parse(["walk", "fig35a"]))
from landscape.walk import preferences
from landscape.walk.opening import open_window
slow = "landscape.scene", "landscape.elements", "landscape.sound", "framelens.tape"
print(*(name for name in sys.modules if name.startswith((*slow, "numpy.random"))))
"""
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment(), capture_output=True, text=True
    )
    assert (done.returncode, done.stderr, done.stdout.strip()) == (0, "", "")


OPENED = """
import json, sys
import numpy as np
from PIL import Image
from framelens.gl.contexts.glfw import GLFWContext
from framelens.gl.framebuffer import read_pixels
from framelens.gl.seam import gl
from landscape.cli import parse
from landscape.commands import walk
from landscape.walk import opening, thumbnails
from landscape.walk.waiting import Waiting

class Hidden(GLFWContext):
    def __init__(self, *given):
        super().__init__(*given[:4], "osmesa")
opening.GLFWContext = Hidden
seen = []

# The picture fills the window, and leaves the state as it was.
image = Image.effect_noise((60, 44), 90).convert("RGBA")
image.putpixel((3, 40), (250, 20, 20, 255))
window = Hidden((60, 44), "", True, False)
before = np.array(gl.glGetFloatv(gl.GL_CURRENT_RASTER_POSITION))
opening.fill(image)
shown = read_pixels((60, 44))
seen.append(bool((shown == np.asarray(image)[..., :3]).all()))
seen.append(bool((before == gl.glGetFloatv(gl.GL_CURRENT_RASTER_POSITION)).all()))
seen.append(gl.glGetError() == gl.GL_NO_ERROR)
window.release()

# A walk goes on in that window, over the same picture, and closes it at its end.
windows, fill, show = [], opening.fill, Waiting.show
def filled(image):
    fill(image)
    windows.append(read_pixels(image.size))
def waited(self, language):
    show(self, language)
    if len(windows) == 1:
        windows.append(read_pixels(self._size))
opening.fill, Waiting.show = filled, waited
options = ["walk", "hall", "--size", "160x90", "--frames", "1", "-q", "--fresh"]
seen.append(walk.run(parse(options)) == 0 and GLFWContext._windows == 0)
at_once, while_building = (each[:40].astype(int) for each in windows)
seen.append(bool(at_once.std() > 20 and abs(at_once - while_building).max() <= 1))
print(json.dumps(seen))
"""


@pytest.mark.seldom(13, first=2)
def test_a_walk_goes_on_in_the_window_that_opened_at_once() -> None:
    done = python(OPENED, env=environment(LANG="C"))
    assert (done.status, done.err) == (0, "")
    assert json.loads(done.out) == [True] * 5
