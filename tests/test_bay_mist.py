"""Mist over the bay: sheets over the sea, thinner over land and at the map's edge, in the light."""

from typing import Any

import numpy as np
import pytest
from flat_land import flat

from framelens.gl.seam import recording
from landscape.elements.best.mist.bay_mist import CLEAR, EDGE, HIGH, LOW, BayMist, opacity, sheet
from landscape.elements.settings import Settings, Sun
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField
from landscape.offscreen import Offscreen
from landscape.settings.declare import with_settings

SEA = HeightField(np.zeros((4, 4), np.float32), 40.0, 0.6)
OVER_THE_BAY = (8.6, 1.4, 33.7, 25.0, -5.0)
ONLY = ("ground", "water", "mist", "fog", "dragon")
FEW = {"ground.texture_size": 256, "ground.stones": 500}


def at(field: HeightField, x: float, height: float, z: float = 20.0) -> float:
    return float(opacity(field, np.array([x]), field.water_level + height, np.array([z]))[0])


def test_a_sheet_is_dense_over_the_sea_and_ends_softly_at_the_map_s_edge() -> None:
    assert at(SEA, 20.0, HIGH) == at(SEA, EDGE, LOW) > 0.15
    assert at(SEA, 0.0, HIGH) == at(SEA, 40.0, HIGH) == at(SEA, 20.0, HIGH, 40.0) == 0.0
    assert 0.0 < at(SEA, 1.0, HIGH) < at(SEA, 2.0, HIGH) < at(SEA, 20.0, HIGH)


def test_a_sheet_thins_out_where_the_ground_comes_near_and_under_it_there_is_none() -> None:
    beach = HeightField(np.linspace(0.3, 1.5, 40, dtype=np.float32)[None].repeat(40, 0), 40.0, 0.6)
    found = [at(beach, x, 0.2) for x in np.linspace(6.0, 34.0, 30)]
    assert (np.diff(found) <= 1e-9).all() and found[0] > 0.9 and found[-1] == 0.0
    height = float(beach.terrain_height(15.0, 20.0))
    assert at(beach, 15.0, height - 0.6) == 0.0 < at(beach, 15.0, height - 0.6 + CLEAR / 2)


def test_a_sheet_has_only_triangles_that_show_and_faces_up() -> None:
    assert not len(sheet(flat().field, Sun(), 0.5, -1.0).triangles)
    mesh = sheet(SEA, Sun(), 0.5, HIGH)
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 1] > 0).all()
    assert mesh.colors is not None and 0 < mesh.colors[:, 3].max() <= 0.5


def test_the_mist_has_the_sun_s_tint() -> None:
    white, red = (sheet(SEA, Sun(tint=tint), 0.5, HIGH).colors for tint in ((1, 1, 1), (1, 0, 0)))
    assert white is not None and red is not None
    assert np.allclose(red[:, 0], white[:, 0]) and not red[:, 1:3].any()


def picture(kt: float = 40.0, **settings: Any) -> np.ndarray:
    given = {name.replace("_", ".", 1): value for name, value in settings.items()}
    with Offscreen((120, 90), settings=FEW | given, samples=0, only=ONLY) as view:
        view.look(Pose(*OVER_THE_BAY), kt)
        return view.draw().astype(np.int16)


@pytest.mark.seldom(13, first=12)
def test_mist_lies_over_the_bay_where_it_is_asked_for_and_drifts() -> None:
    clear = picture()
    misty = picture(mist_enabled=True)
    later = picture(400.0, mist_enabled=True)
    assert Settings().mist.enabled is False
    # The lower half of the picture is sea.
    assert (misty - clear)[45:].mean() > 15
    assert np.abs(later - misty)[45:].max() > 15


@pytest.mark.seldom(10, first=9)
def test_the_mist_is_drawn_over_the_water_and_before_the_sprites() -> None:
    given = {"mist.enabled": True, "mist.sheets": 3}
    with Offscreen((60, 45), settings=FEW | given, samples=0, only=(*ONLY, "trees")) as view:
        view.look(Pose(*OVER_THE_BAY), 40.0)
        with recording() as recorder:
            view.draw()
    order = [call.element for call in recorder.calls if call.pass_ == "main"]
    first, last = order.index("mist"), len(order) - order[::-1].index("mist")
    assert "water" in order[:first] and "water" not in order[last:]
    assert "trees" in order[last:]
    assert sum(call.name == "glCallList" and call.element == "mist" for call in recorder.calls) == 3


@pytest.mark.parametrize("key", ["mist.density", "sun.tint", "water.level"])
def test_what_the_sheets_are_made_from_makes_them_anew(key: str) -> None:
    base = with_settings(Settings(), {"mist.enabled": True})
    value = {"mist.density": 0.1, "sun.tint": (1.0, 0.5, 0.5), "water.level": 0.5}[key]
    assert BayMist.built_from(base) != BayMist.built_from(with_settings(base, {key: value}))
    assert BayMist.built_from(base) == BayMist.built_from(with_settings(base, {"fog.density": 0.1}))
