"""Every element in both presets: state, stacks and errors as found; release twice; no leak.

In every GL test ``stage.frame`` checks that a frame leaves the state as it found it. Here each
element is drawn under that check, with all its switches.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gl_state import changes, snapshot
from stage import SIZE, SMALL, SMALL_BEST, Stage, kind_in, live_names, write_plain, write_ply

from framelens.base.errors import InputError
from framelens.gl.seam import gl, recording
from framelens.gl.state import attrib, client_arrays, flat_projection, front_faces, matrix
from landscape.elements import sun
from landscape.elements.atlas import CELLS
from landscape.elements.best.mist.bay_mist import BayMist
from landscape.elements.best.sea.sea import Sea
from landscape.elements.ground import Ground
from landscape.elements.map import Map
from landscape.elements.reflection import mirrored
from landscape.elements.settings import PRESETS, Settings, preset
from landscape.elements.water_surface import WaterSurface
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField
from landscape.island.island import Island
from landscape.island.slots import (
    CASTLE,
    DRAGON,
    GRASS,
    GROUND,
    PLANTED,
    RABBIT,
    SKY,
    SLOTS,
    SWORD,
)
from landscape.scene.scene import Moment, begin_frame
from landscape.settings.declare import with_settings

POSE = Pose(20.0, 3.5, 21.0, 10.0, -6.0)
PLACED = {
    **{"castle.x": 20.0, "castle.z": 15.0, "rabbit.x": 20.2, "rabbit.z": 20.0},
    **{"dragon.x": 20.0, "dragon.z": 19.0, "ground.height_image": "height.png"},
}
MANY = {"grass.count": 200_000, "trees.count": 900, "plants.count": 1500}  # some are in view

# Mist lies over water: here it is all around, and below the eye.
LAKE = HeightField(np.zeros((4, 4), np.float32), 40.0, 3.0)

Build = Callable[[Settings, Assets, Ground], Any]
ELEMENTS: dict[str, Build] = {
    "ground": lambda settings, assets, ground: kind_in(GROUND, settings)(
        settings, assets, sun.direction(settings.sun)
    ),
    "water": lambda settings, assets, ground: WaterSurface(settings, assets),
    "sea": lambda settings, assets, ground: Sea(settings, assets, ground.field),
    "sky": lambda settings, assets, ground: kind_in(SKY, settings)(settings, assets),
    "sprites": lambda settings, assets, ground: kind_in(PLANTED, settings)(
        settings, assets, ground, 1, {"trees", "deer", "plants"}
    ),
    "grass": lambda settings, assets, ground: kind_in(GRASS, settings)(settings, assets, ground, 1),
    "castle": lambda settings, assets, ground: kind_in(CASTLE, settings)(
        settings, assets, ground.field
    ),
    "rabbit": lambda settings, assets, ground: kind_in(RABBIT, settings)(
        settings, assets, ground.field
    ),
    "dragon": lambda settings, assets, ground: kind_in(DRAGON, settings)(settings, assets),
    "mist": lambda settings, assets, ground: BayMist(settings, assets, LAKE),
    "sword": lambda settings, assets, ground: kind_in(SWORD, settings)(settings, assets),
    "map": lambda settings, assets, ground: Map(settings, assets, ground.field),
}
ELSEWHERE = {"stones", "ring", "query", "under"}  # in tests of their own


def test_each_place_of_the_island_is_tried_here() -> None:
    left_out = {slot.name for slot in SLOTS} - ELEMENTS.keys() - ELSEWHERE
    assert left_out == set(), "add these to ELEMENTS"


@pytest.fixture(scope="module")
def assets(tmp_path_factory) -> Assets:
    folder = tmp_path_factory.mktemp("state")
    colours = {name: (90, 120, 60, 255) for name in CELLS}
    write_plain(folder, {**colours, "ground_large.png": (60, 140, 40)})
    cube = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
    for name in ("rabbit.ply", "dragon.ply"):
        faces = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
        write_ply(folder / name, cube, faces)
    return Assets(folder)


def configured(name: str) -> Settings:
    return with_settings(
        preset(name), {**(SMALL_BEST if name == "best" else SMALL), **PLACED, **MANY}
    )


@pytest.fixture(params=list(PRESETS))
def values(request: pytest.FixtureRequest) -> Settings:
    """The settings of each preset, with few objects."""
    return configured(request.param)


@pytest.fixture
def ground(stage: Stage, values: Settings, assets: Assets):
    made = kind_in(GROUND, values)(values, assets, sun.direction(values.sun))
    yield made
    stage.enter()
    made.release()


@pytest.mark.parametrize("name", ELEMENTS)
@pytest.mark.sweep(4)
def test_drawing_leaves_the_state_as_found_and_release_leaves_no_name(
    stage: Stage, values: Settings, assets: Assets, ground: Ground, name: str
) -> None:
    before = live_names()
    element = ELEMENTS[name](values, assets, ground)
    made = [after - names for names, after in zip(before, live_names(), strict=True)]
    assert any(made), "every element keeps a texture or a display list"
    blank = None
    for is_mirrored in (False, True):
        with stage.frame(values, POSE, kt=33.0, fog=True, step=7.0, stroke=1) as frame:
            blank = stage.read()
            given = replace(frame, mirrored=is_mirrored)
            found = snapshot()
            if is_mirrored:
                with mirrored(values):
                    inside = snapshot()
                    element.draw(given)
                    assert not changes(inside, snapshot())
            else:
                element.draw(given)
            assert not changes(found, snapshot())
            if not is_mirrored:
                assert (stage.read() != blank).any(), "it should have drawn something"

    element.release()
    assert live_names() == before
    element.release()
    assert live_names() == before
    assert int(gl.glGetError()) == 0


def test_a_frame_would_notice_changed_state(stage: Stage, values: Settings) -> None:
    def change_fog() -> None:
        gl.glFogf(gl.GL_FOG_DENSITY, 0.5)

    def unbalanced() -> None:
        gl.glPushMatrix()

    def change_material() -> None:
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, np.full(4, 0.5, np.float32))

    def change_sources() -> None:
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_SRC0_RGB, gl.GL_PREVIOUS)
        gl.glActiveTexture(gl.GL_TEXTURE0)

    def texture_second() -> None:
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glEnable(gl.GL_TEXTURE_2D)

    def turn_texture() -> None:
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glRotatef(5.0, 0.0, 0.0, 1.0)
        gl.glMatrixMode(gl.GL_MODELVIEW)

    mischief = {
        "GL_BLEND": lambda: gl.glEnable(gl.GL_BLEND),
        "GL_TEXTURE1.GL_TEXTURE_2D": lambda: (
            gl.glActiveTexture(gl.GL_TEXTURE1),
            gl.glEnable(gl.GL_TEXTURE_2D),
        ),
        "GL_ACTIVE_TEXTURE": lambda: gl.glActiveTexture(gl.GL_TEXTURE1),
        "GL_CURRENT_COLOR": lambda: gl.glColor4f(0.5, 0.5, 0.5, 1.0),
        "GL_DEPTH_WRITEMASK": lambda: gl.glDepthMask(gl.GL_FALSE),
        "GL_FOG_DENSITY": change_fog,
        "GL_MODELVIEW_STACK_DEPTH": unbalanced,
        "GL_CLIENT_ACTIVE_TEXTURE": lambda: gl.glClientActiveTexture(gl.GL_TEXTURE1),
        "GL_FRONT_FACE": lambda: gl.glFrontFace(gl.GL_CW),
        "GL_FRONT.GL_DIFFUSE": change_material,
        "GL_TEXTURE1.GL_TEXTURE_ENV.GL_SRC0_RGB": change_sources,
        "GL_TEXTURE0.GL_TEXTURE_MATRIX": turn_texture,
        "GL_LIGHT1.GL_AMBIENT": lambda: gl.glLightfv(
            gl.GL_LIGHT1, gl.GL_AMBIENT, np.full(4, 0.5, np.float32)
        ),
        "GL_BLEND_EQUATION_RGB": lambda: gl.glBlendEquation(gl.GL_FUNC_SUBTRACT),
    }
    for name, do in mischief.items():
        depth = int(gl.glGetIntegerv(gl.GL_MODELVIEW_STACK_DEPTH))
        with pytest.raises(AssertionError, match=name):
            with stage.borrowed():
                with stage.frame(values, POSE):
                    do()
        gl.glClientActiveTexture(gl.GL_TEXTURE0)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        while int(gl.glGetIntegerv(gl.GL_MODELVIEW_STACK_DEPTH)) > depth:
            gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glLoadIdentity()
        gl.glMatrixMode(gl.GL_MODELVIEW)


@pytest.mark.parametrize(
    "block",
    [
        lambda: attrib(gl.GL_ENABLE_BIT | gl.GL_FOG_BIT),
        matrix,
        lambda: flat_projection(-1, 1, -1, 1, 0.1, 2),
        flat_projection,
        lambda: client_arrays(
            np.zeros((3, 3), np.float32),
            np.zeros((3, 3), np.float32),
            np.zeros((3, 4), np.uint8),
            [np.zeros((3, 2), np.float32)] * 3,
        ),
        front_faces,
    ],
    ids=["attrib", "matrix", "ortho", "identity", "arrays", "front faces"],
)
def test_scoped_state_comes_back_even_after_an_exception(stage: Stage, block) -> None:
    with stage.frame(Settings(), POSE):
        before = snapshot()
        with pytest.raises(RuntimeError):
            with block():
                gl.glLoadIdentity() if block is matrix else None
                raise RuntimeError
        assert not changes(before, snapshot())
        with block():
            pass


def test_a_whole_frame_leaves_the_state_as_its_beginning_set_it(
    stage: Stage, values: Settings, assets: Assets
) -> None:
    before = live_names()
    island = Island(values, assets)
    moment = Moment(POSE, SIZE, 12.0, 3.0, 2)
    with stage.borrowed():
        far = 1.5 * values.water.horizon
        begin_frame(moment, values.camera, values.sun, values.fog, True, far)
        found = snapshot()
        for wireframe in (False, True):
            island.draw(replace(moment, wireframe=wireframe))
            assert not changes(found, snapshot())
    island.release()
    island.release()
    assert live_names() == before


def test_an_island_that_cannot_be_built_releases_what_it_had_built(
    stage: Stage, values: Settings, tmp_path: Path
) -> None:
    folder = write_plain(tmp_path)
    (folder / "sword_rest.png").write_bytes(b"not an image")
    before = live_names()
    with pytest.raises(InputError, match=r"sword_rest\.png"):
        Island(values, Assets(folder), only=("ground", "water", "sky", "castle", "sword"))
    assert live_names() == before


def test_a_frame_after_the_first_makes_and_deletes_no_objects(
    stage: Stage, values: Settings, assets: Assets
) -> None:
    island = Island(values, assets)
    with stage.borrowed():
        island.draw(Moment(POSE, SIZE))  # what waits for its size or first use is made now
        with recording() as recorder:
            island.draw(Moment(POSE, SIZE, 9.0))
    island.release()
    names = {call.name for call in recorder.calls}
    assert not {name for name in names if name.startswith(("glGen", "glDelete", "glTexImage"))}
