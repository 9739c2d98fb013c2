"""The exhibits of hidden lines and of solids, and what all exhibits leave behind."""

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
import pytest
from gl_state import changes, snapshot

from framelens.gl.seam import gl
from framelens.gl.state import front_faces
from landscape.frame import Pose
from landscape.gl.draw import draw_mesh
from landscape.hall import plan
from landscape.hall.exhibits.cabinet import Cabinet
from landscape.hall.exhibits.hidden_lines import INK, PAPER, draw_lines
from landscape.hall.exhibits.niche import MIDDLE, SOLIDS, plates
from landscape.hall.exhibits.solids import BEAM, HEIGHT, RADIUS, TILT, TURN, beam, sphere
from landscape.offscreen import Offscreen

SIZE = (160, 120)
AT_SOLIDS = Pose(1.04, 0.16, plan.ALCOVES[SOLIDS], 270.0, -12.0)
KT = 33.0


@pytest.fixture(scope="module")
def view() -> Iterator[Offscreen]:
    with Offscreen(SIZE, samples=0, place="hall", only=("exhibits",)) as opened:
        yield opened


def picture(view: Offscreen, pose: Pose, kt: float = KT, **changed: Any) -> np.ndarray:
    """Return a picture with other settings of the exhibits."""
    view.look(pose, kt)
    values = view.scene.settings
    view.scene.elements[Cabinet].take(type(values)(exhibits=type(values.exhibits)(**changed)))
    try:
        return view.draw().astype(np.int16)
    finally:
        view.scene.elements[Cabinet].take(values)


def rays(pose: Pose) -> np.ndarray:
    """Return the direction of the line of sight through each pixel, (h, w, 3)."""
    width, height = SIZE
    half = np.tan(np.radians(66.0 / 2))
    y, x = np.mgrid[:height, :width] + 0.5
    yaw, pitch = np.radians(pose.yaw), np.radians(pose.pitch)
    ahead = np.array(pose.forward)
    right = np.array([np.cos(yaw), 0.0, np.sin(yaw)])
    up = np.array([-np.sin(pitch) * np.sin(yaw), np.cos(pitch), np.sin(pitch) * np.cos(yaw)])
    u = (2 * x / width - 1) * half * width / height
    v = (1 - 2 * y / height) * half
    return np.asarray(ahead + u[..., None] * right + v[..., None] * up)


def through_solids() -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return where the lines of sight enter and leave the sphere and the beam, (h, w) each."""
    a, b = np.radians(TURN * KT), np.radians(TILT)
    turn = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    tilt = np.array([[np.cos(b), -np.sin(b), 0], [np.sin(b), np.cos(b), 0], [0, 0, 1]])
    own = (turn @ tilt).T
    eye = own @ (
        np.array([AT_SOLIDS.x, AT_SOLIDS.y, AT_SOLIDS.z]) - (MIDDLE, HEIGHT, plan.ALCOVES[SOLIDS])
    )
    way = rays(AT_SOLIDS) @ own.T
    square, half = (way * way).sum(axis=2), way @ eye
    root = half**2 - square * (eye @ eye - RADIUS**2)
    met = root > 0
    far = np.sqrt(np.where(met, root, 0.0))
    ball = [np.where(met, (-half + side * far) / square, np.inf * -side) for side in (-1, 1)]
    ends = (np.array([[-1.0], [1.0]]) * BEAM - eye)[:, None, None] / way
    bar = [ends.min(axis=0).max(axis=2), ends.max(axis=0).min(axis=2)]
    none = bar[0] >= bar[1]
    return ball[0], ball[1], np.where(none, np.inf, bar[0]), np.where(none, -np.inf, bar[1])


def expected(operation: str) -> np.ndarray:
    """Return what is seen where: 0 nothing, 1 the sphere, 2 the beam, (h, w)."""
    a0, a1, b0, b1 = through_solids()
    ball, bar = a0 < a1, b0 < b1
    if operation == "union":
        nearest = np.where(ball & (~bar | (a0 < b0)), 1, 2)
        return np.asarray(np.where(ball | bar, nearest, 0))
    if operation == "intersection":
        both = ball & bar & (np.maximum(a0, b0) < np.minimum(a1, b1))
        return np.asarray(np.where(both, np.where(a0 > b0, 1, 2), 0))
    inside = bar & (b0 < a0) & (a0 < b1)
    shown = np.where(~inside, 1, np.where(b1 < a1, 2, 0))
    return np.asarray(np.where(ball, shown, 0))


def shown(view: Offscreen, **settings: Any) -> np.ndarray:
    """Return what the picture shows of the solids: 0 nothing, 1 blue enamel, 2 gold, (h, w)."""
    nothing = picture(view, AT_SOLIDS, solids=False)
    found = picture(view, AT_SOLIDS, **settings)
    changed = np.abs(found - nothing).max(axis=2) > 0
    return np.where(changed, np.where(found[..., 2] > found[..., 0], 1, 2), 0)


def overlap(one: np.ndarray, other: np.ndarray) -> float:
    return float((one & other).sum() / (one | other).sum())


@pytest.mark.seldom(3)
@pytest.mark.parametrize("operation", ["union", "intersection", "difference"])
def test_the_solids_show_what_intervals_on_lines_of_sight_give(
    view: Offscreen, operation: str
) -> None:
    found, wanted = shown(view, solids_operation=operation), expected(operation)
    for value in (1, 2):
        assert (wanted == value).sum() > 60
    # The pedestal is nearer than nothing of it.
    assert overlap(found > 0, wanted > 0) > 0.98
    assert ((found == wanted) | (found * wanted == 0)).mean() > 0.99


def hole() -> np.ndarray:
    """Return where one looks through the sphere, but for the rim, (h, w)."""
    through = (expected("difference") == 0) & (through_solids()[0] < np.inf)
    for step in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        through = through & np.roll(through, step, (0, 1))
    assert through.sum() > 20
    return through


def test_without_the_stencil_the_sphere_hides_its_hole(view: Offscreen) -> None:
    assert (shown(view, solids_stencil=False)[hole()] == 1).all()
    assert (shown(view)[hole()] == 0).all()


def test_what_was_taken_back_does_not_hide_the_alcove(view: Offscreen) -> None:
    nothing = picture(view, AT_SOLIDS, solids=False)
    found = picture(view, AT_SOLIDS)
    inner = hole()
    np.testing.assert_array_equal(found[inner], nothing[inner])


def test_the_solids_are_closed_and_the_hole_is_the_beam_inside_out() -> None:
    def volume(mesh: Any) -> float:
        a, b, c = (mesh.vertices[mesh.triangles[:, k]].astype(float) for k in range(3))
        return float((np.cross(a, b) * c).sum() / 6)

    assert abs(volume(sphere()) / (4 / 3 * np.pi * RADIUS**3) - 1) < 0.03
    assert volume(beam(False)) == pytest.approx(8 * np.prod(BEAM), rel=1e-4)
    assert volume(beam(True)) == pytest.approx(-8 * np.prod(BEAM), rel=1e-4)


CORNERS = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * 0.5


def lines_of_a_box(view: Offscreen, offset: bool) -> np.ndarray:
    """Return where the picture of a turned box has ink, (h, w)."""
    with view.targeted():
        gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
        gl.glClearColor(*PAPER, 1.0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        for mode in (gl.GL_PROJECTION, gl.GL_MODELVIEW):
            gl.glMatrixMode(mode)
            gl.glPushMatrix()
            gl.glLoadIdentity()
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glFrustum(-0.5333, 0.5333, -0.4, 0.4, 1.0, 10.0)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glMultMatrixd(np.ascontiguousarray(placed().T))
        draw_lines(partial(draw_mesh, box()), offset)
        found = view._target.read().astype(int)
        for mode in (gl.GL_PROJECTION, gl.GL_MODELVIEW):
            gl.glMatrixMode(mode)
            gl.glPopMatrix()
        gl.glPopAttrib()

    return np.asarray(np.abs(found - np.round(np.array(INK) * 255)).max(axis=2) < 8)


def placed() -> np.ndarray:
    """Return the box's matrix: turned, and 2.6 away."""
    a, b = 0.6, 0.5
    turn = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    tilt = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    found = np.eye(4)
    found[:3, :3] = tilt @ turn
    found[2, 3] = -2.6
    return found


def box() -> Any:
    """Return a box of side 1."""
    from dataclasses import replace

    whole = beam(False)
    return replace(whole, vertices=(whole.vertices / (2 * np.array(BEAM))).astype(np.float32))


def edge_pixels(hidden: bool) -> list[np.ndarray]:
    """Return the pixels (n, 2) along each edge of the box that is hidden, or visible."""
    matrix = placed()
    found = []
    for i in range(8):
        for axis in range(3):
            j = i ^ (4 >> axis)
            if j < i:
                continue
            ends = np.column_stack([CORNERS[[i, j]], [1, 1]]) @ matrix.T
            middle = CORNERS[[i, j]].mean(axis=0)
            # An edge shows if one of its two faces does.
            shows = False
            for side in range(3):
                if side == axis:
                    continue
                normal = np.zeros(3)
                normal[side] = np.sign(middle[side])
                shows |= bool((matrix[:3, :3] @ normal) @ (matrix @ (*middle, 1.0))[:3] < 0)
            if shows == hidden:
                continue
            t = np.linspace(0.08, 0.92, 60)[:, None]
            points = ends[0] * (1 - t) + ends[1] * t
            x = (points[:, 0] / -points[:, 2] / 0.5333 + 1) / 2 * SIZE[0]
            y = (1 - points[:, 1] / -points[:, 2] / 0.4) / 2 * SIZE[1]
            found.append(np.stack([x, y], axis=1).astype(int))

    return found


def near_ink(ink: np.ndarray, pixels: np.ndarray) -> np.ndarray:
    """Return for each pixel whether it or a neighbour has ink."""
    wide = np.zeros_like(ink)
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            wide |= np.roll(ink, (dy, dx), (0, 1))
    return np.asarray(wide[pixels[:, 1], pixels[:, 0]])


def test_all_of_each_visible_edge_is_drawn(view: Offscreen) -> None:
    ink = lines_of_a_box(view, True)
    edges = edge_pixels(hidden=False)
    assert len(edges) == 9
    for pixels in edges:
        assert near_ink(ink, pixels).all()


def test_no_line_is_drawn_that_a_nearer_face_hides(view: Offscreen) -> None:
    ink = lines_of_a_box(view, True)
    with view.targeted(), front_faces():
        near = lines_of_a_box(view, True)
    # What the faces that show do not draw would be a hidden line.
    rows, columns = np.nonzero(ink)
    assert near_ink(near, np.stack([columns, rows], axis=1)).all()


def test_without_the_offset_lines_are_broken(view: Offscreen) -> None:
    whole, broken = lines_of_a_box(view, True).sum(), lines_of_a_box(view, False).sum()
    assert broken < 0.9 * whole


def test_titles_differ_and_fill_their_plates() -> None:
    image = plates().astype(int)
    parts = np.split(image, 6)
    for number, plate in enumerate(parts):
        dark = plate.sum(axis=2) < 160
        assert 0.02 < dark.mean() < 0.3
        assert not dark[:, :14].any() and not dark[:, -14:].any()
        assert all((plate != other).any() for other in parts[number + 1 :])


@pytest.mark.seldom(3)
@pytest.mark.parametrize("number", range(6))
def test_an_exhibit_leaves_state_as_found(view: Offscreen, number: int) -> None:
    pose = Pose(1.15, 0.15, plan.ALCOVES[number], 270.0, -5.0)
    view.look(pose, KT)
    drawn: list[dict[str, Any]] = []
    cabinet = view.scene.elements[Cabinet]
    draw = cabinet.draw

    def checked(frame: Any) -> None:
        drawn.append(snapshot())
        draw(frame)
        drawn.append(snapshot())

    cabinet.draw = checked
    try:
        view.draw()
        view.draw()
    finally:
        cabinet.draw = draw
    assert len(drawn) == 4
    assert not changes(drawn[0], drawn[1]) and not changes(drawn[2], drawn[3])
