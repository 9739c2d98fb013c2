"""A state as JSON that restores it, and as a listing that a person reads."""

import json

import numpy as np
import pytest
from state_calls import CHANGES, Fresh, scrambled

from framelens.gl.seam import gl
from framelens.state.state import difference, read, restore
from framelens.state.state_text import as_json, as_text, difference_as_text


def test_json_has_the_fewest_digits_and_restores_the_state(fresh: Fresh) -> None:
    fresh()
    scrambled(1)
    gl.glFogf(gl.GL_FOG_DENSITY, 0.12)
    masks, client = [int(gl.GL_FOG_BIT | gl.GL_EVAL_BIT)], [int(gl.GL_CLIENT_VERTEX_ARRAY_BIT)]
    gl.glPushAttrib(masks[0])
    gl.glPushClientAttrib(client[0])
    scrambled(2, 40)
    gl.glFogf(gl.GL_FOG_DENSITY, 0.13)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    gl.glClipPlane(gl.GL_CLIP_PLANE0, np.array([0.1, 0.2, 0.3, 1 / 3]))
    state = read(masks, client)
    written = json.dumps(as_json(state))
    found = json.loads(written)
    assert found["GL_FOG_DENSITY"] == 0.13
    plane = "GL_CLIP_PLANE0.equation"  # in double precision: not shortened
    assert found[plane] == state[plane] == pytest.approx([0.1, 0.2, 0.3, 1 / 3])
    assert found["GL_ATTRIB_STACK"][0]["mask"] == "GL_FOG_BIT | GL_EVAL_BIT"
    assert found["GL_ATTRIB_STACK"][0]["saved"]["GL_FOG_DENSITY"] == 0.12
    assert found["GL_CLIENT_ATTRIB_STACK"][0]["mask"] == "GL_CLIENT_VERTEX_ARRAY_BIT"
    fresh()
    restore(found)
    assert difference(state, read(masks, client)) == {}


def test_a_listing_has_groups_and_marks_what_differs_from_the_initial_state(
    fresh: Fresh,
) -> None:
    fresh()
    assert not [line for line in as_text(read()) if line.startswith("  *")]
    gl.glEnable(gl.GL_LIGHT2)
    gl.glFogf(gl.GL_FOG_DENSITY, 0.12)
    gl.glStencilMask(0x0F)
    listing = list(as_text(read()))
    marked = [" ".join(line.split()) for line in listing if line.startswith("  *")]
    assert marked == [
        "* GL_FOG_DENSITY 0.12",
        "* GL_LIGHT2 on",
        "* GL_STENCIL_WRITEMASK 0xf",
        "* GL_STENCIL_BACK_WRITEMASK 0xf",
    ]
    groups = [line for line in listing if not line.startswith(" ")]
    assert groups[:4] == ["transform", "current values", "colouring and lighting", "rasterization"]
    plain = [" ".join(line.split()) for line in listing]
    assert "GL_LIGHT0 to GL_LIGHT1 initial values" in plain
    assert "GL_LIGHT3 to GL_LIGHT7 initial values" in plain
    assert "GL_LIGHT2.GL_SPOT_CUTOFF 180" in plain
    assert len(listing) < 300


def test_a_matrix_is_listed_in_rows_with_the_translation_in_its_last_column(
    fresh: Fresh,
) -> None:
    fresh()
    before = read()
    gl.glPushMatrix()
    gl.glTranslatef(1.0, 2.0, 3.5)
    listing = list(as_text(read()))
    at = next(k for k, line in enumerate(listing) if "GL_MODELVIEW_MATRIX" in line)
    rows = [line.split()[-4:] for line in listing[at : at + 4]]
    assert rows == [
        ["1", "0", "0", "1"],
        ["0", "1", "0", "2"],
        ["0", "0", "1", "3.5"],
        ["0", "0", "0", "1"],
    ]
    compared = list(difference_as_text(difference(before, read())))
    assert compared[0] == "transform"
    assert compared[1].split() == ["GL_MODELVIEW_STACK_DEPTH", "1", "->", "2"]
    assert compared[4].split() == ["0", "0", "1", "0", "0", "0", "1", "3.5"]


def test_every_kind_of_value_is_listed(fresh: Fresh) -> None:
    fresh()
    before = read()
    rng = np.random.default_rng(3)
    for change in CHANGES:
        change(rng)
    gl.glPushAttrib(gl.GL_FOG_BIT)
    after = read([int(gl.GL_FOG_BIT)])
    assert list(as_text(after))
    compared = "\n".join(difference_as_text(difference(before, after)))
    assert "GL_POLYGON_STIPPLE.pattern" in compared
    for name in difference(before, after):
        assert name in compared
