"""Evidence is compared with what its calls draw: a picture that they do not give is refused."""

import base64
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from solved import solved

from landscape.course import exercise as exercises
from landscape.course.exercise import Grader, Report
from landscape.course.grader import recorded
from landscape.course.grader.evidence import Evidence
from landscape.course.shelf import exercise
from landscape.course.solutions import whole

PATIENCE = 100.0  # seconds a program may take here: the machine may be busy with other tests
NAME = "first_drawing"


@pytest.fixture(scope="module")
def grader() -> Iterator[Grader]:
    with Grader(PATIENCE) as found:
        yield found


@pytest.fixture(scope="module")
def right(grader: Grader) -> Report:
    return grader.check(exercise(NAME).folder / "solution.py")


def checked(grader: Grader, folder: Path, code: str) -> Report:
    path = folder / "mine.py"
    path.write_text(code, encoding="utf-8")
    return grader.check(path)


# What a program does to the witness of its own process.
BRINGS = """
import base64, sys, zlib
import numpy
witness = sys.modules["landscape.course.grader.witness"]
pictures = iter({pictures!r})
witness.read_pixels = lambda size: numpy.frombuffer(
    zlib.decompress(base64.b64decode(next(pictures))), numpy.uint8
).reshape(size[1], size[0], 3)
"""
CLAIMS = """
import sys
writer = sys.modules["landscape.course.grader.evidence_file"].Writer
def written(self, of=writer.written):
    for number in range(len(self._values)):
        self._values[number] += 0.5
    return of(self)
writer.written = written
"""
SENDS = """
import sys
recorded = sys.modules["landscape.course.grader.recorded"]
recorded.Writer.written = lambda *_: b"other bytes"
"""
# Calls that end in a crash, or do not come to an end of the frame, when they are made again.
BREAKS = """
import sys
import numpy
witness = sys.modules["landscape.course.grader.witness"]
recorded = sys.modules["landscape.course.grader.recorded"]
witness.read_pixels = lambda size, of=witness.read_pixels: 255 - of(size)
def written(self, source, takes, of=recorded.Writer.written):
    self.calls.append({call})
    made = self.blobs.add(numpy.array([len(self.calls) - 1], numpy.int32).tobytes())
    return of(self, source, {takes})
recorded.Writer.written = written
"""
ALL = '[{**take, "made": [made] * len(take["made"])} for take in takes]'


def with_pictures(report: Report) -> str:
    assert report.work is not None
    pictures = [
        base64.b64encode(zlib.compress(frame.picture.tobytes())).decode()
        for frame in report.work.frames.values()
    ]
    return BRINGS.format(pictures=pictures)


@pytest.mark.parametrize(
    "kind",
    [
        *("brings the right pictures", "claims other calls", "sends bytes"),
        *("cannot be called", "has too few frames", "has no take"),
    ],
)
def test_what_the_program_did_not_draw_is_refused(
    kind: str, grader: Grader, right: Report, tmp_path: Path
) -> None:
    folder = exercise(NAME).folder
    program, forgery = {
        "brings the right pictures": ("start.py", with_pictures(right)),
        "claims other calls": ("solution.py", CLAIMS),
        "sends bytes": ("solution.py", SENDS),
        "cannot be called": ("solution.py", BREAKS.format(call=["glFlush", 1], takes=ALL)),
        "has too few frames": (
            "solution.py",
            BREAKS.format(call=["glFlush"], takes='[{**take, "made": []} for take in takes]'),
        ),
        "has no take": ("solution.py", BREAKS.format(call=["glFlush"], takes="[]")),
    }[kind]
    code = whole(folder / program, folder)
    assert code.count("import glfw\n") == 1
    report = checked(grader, tmp_path, code.replace("import glfw\n", f"import glfw\n{forgery}"))
    assert report.error == {"word": "forged", "frame": 0}
    assert report.results == () and not report.passed


# A right program that hands OpenGL its data in many ways.
WAYS = """# exercise: first_drawing
import ctypes
import glfw
import numpy as np
from OpenGL.GL import *
from OpenGL.GLU import *
from OpenGL.arrays import vbo

def main():
    glfw.init()
    window = glfw.create_window(96, 64, "", None, None)
    glfw.make_context_current(window)
    points = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], np.float32)
    buffer = vbo.VBO(np.hstack([points, points * 0.5 + 0.5]).astype(np.float32))
    own = glGenBuffers(1)
    glBindBuffer(GL_ARRAY_BUFFER, own)
    glBufferData(GL_ARRAY_BUFFER, 36, points.tobytes(), GL_STATIC_DRAW)
    glBindBuffer(GL_ARRAY_BUFFER, 0)
    texture = glGenTextures(1)
    glBindTexture(GL_TEXTURE_2D, texture)
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
    texels = bytes(range(0, 240, 20))
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, texels)
    sphere = gluNewQuadric()
    listed = glGenLists(2)
    glNewList(listed, GL_COMPILE)
    gluSphere(sphere, 0.3, 8, 6)
    glEndList()
    number = 0
    while not glfw.window_should_close(window):
        number += 1
        glViewport(0, 0, *glfw.get_framebuffer_size(window))
        if number < 3:
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glPushMatrix()
        glRotatef(number * 20, 0, 0, 1)
        with buffer:
            glEnableClientState(0x8074)
            glEnableClientState(GL_COLOR_ARRAY)
            glVertexPointer(3, GL_FLOAT, 24, buffer)
            glColorPointer(3, GL_FLOAT, 24, buffer + 12)
            glDrawArrays(GL_TRIANGLES, 0, 3)
            glDisableClientState(GL_COLOR_ARRAY)
        glScalef(0.5, 0.5, 1)
        glBindBuffer(GL_ARRAY_BUFFER, own)
        glVertexPointer(3, GL_FLOAT, 0, ctypes.c_void_p(0))
        glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, np.array([0, 1, 2], np.uint32))
        glBindBuffer(GL_ARRAY_BUFFER, 0)
        glVertexPointer(3, GL_FLOAT, 0, points * 0.5)
        glDrawElements(GL_LINE_LOOP, 3, GL_UNSIGNED_BYTE, (ctypes.c_ubyte * 3)(0, 1, 2))
        glDisableClientState(0x8074)
        glPopMatrix()
        glCallLists(np.array([listed], np.uint32))
        glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 10, 10, 2, 2)
        glEnable(GL_TEXTURE_2D)
        glRectf(-0.9, 0.5, -0.5, 0.9)
        glDisable(GL_TEXTURE_2D)
        color = glReadPixels(5, 5, 1, 1, GL_RGB, GL_FLOAT)
        glColor3fv(color.ravel())
        glRasterPos2f(0.5, 0.5)
        glDrawPixels(4, 4, GL_RGB, GL_UNSIGNED_BYTE, np.arange(48, dtype=np.uint8))
        glfw.swap_buffers(window)
        glfw.poll_events()

main()
"""
ADDRESSES = WAYS.replace(
    "glVertexPointer(3, GL_FLOAT, 0, points * 0.5)",
    """
        points = points.copy()
        glVertexPointer(3, GL_FLOAT, 0, ctypes.c_void_p(points.ctypes.data))
""".strip(),
)


@pytest.mark.parametrize("kind", ["arrays, buffers, textures and lists", "an address of memory"])
def test_a_right_program_is_not_refused(
    kind: str, grader: Grader, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[Evidence] = []

    def noted(path: Path, *given: Any) -> Any:
        found = evidence(path, *given)
        if path.name in ("mine.py", recorded.PLAYER.name):
            seen.append(found[0])
        return found

    evidence = exercises._evidence
    monkeypatch.setattr(exercises, "_evidence", noted)
    code = ADDRESSES if "address" in kind else WAYS
    report = checked(grader, tmp_path, code)
    assert report.error is None and report.work is not None
    if "address" in kind:
        assert seen[0].made is None and len(seen) == 1
    else:
        assert isinstance(seen[-1], Evidence) and len(seen) == 2
        loops = [draw for draw in report.work.frame(0).draws if draw.mode == "GL_LINE_LOOP"]
        assert [len(draw.vertices) for draw in loops] == [3], "0x8074 is GL_VERTEX_ARRAY"


def test_evidence_whose_draws_cannot_be_computed_ends_in_one_line(
    grader: Grader, tmp_path: Path
) -> None:
    code = solved(NAME)
    forgery = """
import sys
state = sys.modules["landscape.course.grader.witness"].state
state.read = lambda: {"GL_FOG": True}
"""
    report = checked(grader, tmp_path, code.replace("import glfw\n", f"import glfw\n{forgery}"))
    assert report.error is not None and report.error["word"] == "died"
