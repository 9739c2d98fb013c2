"""Several individuals of trees and deer, where they stand, and the shadow at their feet."""

from pathlib import Path

import numpy as np
import pytest
from hill import green_in_the_west, hill, refine
from PIL import Image
from sprite_stage import BACKGROUND, COLOURS, element, pictures, put, seen
from stage import Stage
from test_time import seen as looking

from landscape.elements.best.sprites.contact import WITHIN
from landscape.elements.best.sprites.individuals import (
    BRAMBLE,
    CONTACT,
    FIRST,
    HAZEL,
    OAK_LEANING,
    UNDERGROWTH,
    files,
)
from landscape.elements.best.sprites.refined_sprites import RefinedSprites
from landscape.elements.best.sprites.relighting import corner_light
from landscape.elements.planting import DEER
from landscape.elements.settings import preset
from landscape.elements.sprite_names import HERBS, MORE_FILES
from landscape.files.images import bled
from landscape.geometry.height_field import greenness
from landscape.settings.declare import with_settings
from landscape.studio.build import encoded

VARIOUS = {"trees__grouped": True, "trees__variety": True, "trees__species": 4}
GREEN, WHITE = (0, 200, 0, 255), (255, 255, 255, 255)
DRAWN = {"trees.grouped": True, "trees.variety": True, "deer.variety": True}


def test_a_species_has_several_individuals_and_their_cells_still_say_which_it_is() -> None:
    trees = refine({"trees"}, trees__count=900, **VARIOUS)
    assert set(np.unique(trees.cells)) == {0, 1, 2, 3}
    for cell in range(4):
        assert len(np.unique(trees.pictures[trees.cells == cell])) >= 3
    assert not np.isin(trees.pictures, (4, 5, 6, 7, CONTACT)).any()


def test_without_variety_a_sprite_s_picture_is_that_of_its_species() -> None:
    plain = refine(trees__grouped=True, plants__species=5)
    assert (plain.pictures == plain.cells).all()


def test_undergrowth_stands_beside_grown_trees_and_is_lower() -> None:
    trees = refine({"trees"}, trees__count=900, **VARIOUS)
    bush = np.isin(trees.pictures, (HAZEL, BRAMBLE))
    grown = ~bush & np.isin(trees.pictures, (0, 1, 2, OAK_LEANING))
    assert 0.1 < bush.mean() < UNDERGROWTH + 0.1
    assert trees.sizes[bush, 1].max() < np.median(trees.sizes[grown, 1])
    xz = trees.positions[:, [0, 2]]
    away = np.hypot(*(xz[bush][:, None] - xz[~bush]).transpose(2, 0, 1)).min(axis=1)
    assert np.median(away) < 0.3
    x, y, z = trees.positions.T
    assert np.allclose(y, hill().terrain_height(x, z))


def test_trees_of_a_group_have_many_heights() -> None:
    heights = refine({"trees"}, trees__count=900, **VARIOUS).sizes[:, 1]
    assert heights.max() > 3 * heights.min() and heights.std() > 0.08


def test_deer_of_several_poses_stand_on_gentle_grass_their_hooves_in_it() -> None:
    kinds = {"deer__species": 2, "deer__variety": True, "trees__grouped": True}
    deer = refine({"deer"}, deer__count=200, **kinds)
    x, y, z = deer.positions.T
    assert (greenness(green_in_the_west(x, z)) > 0.6).all()
    assert (hill().slope(x, z) < 0.56).all()
    sunk = (hill().terrain_height(x, z) - y) / deer.sizes[:, 1]
    assert ((sunk > 0.01) & (sunk < 0.05)).all()
    for cell in (DEER, DEER + 1):
        assert len(np.unique(deer.pictures[deer.cells == cell])) == 2


def test_by_day_trees_are_darker_on_the_side_away_from_the_sun_and_yellow_against_it() -> None:
    sun = preset("best").sun
    assert corner_light(sun, looking(sun.azimuth), 0.0) is None
    left, right = corner_light(sun, looking(sun.azimuth + 90.0), 1.0)[[3, 2]]
    assert np.allclose(left, 1.0) and (right < 0.8).all() and right[2] > right[0]
    against = corner_light(sun, looking(sun.azimuth), 1.0)[3]
    assert against[1] > 1.3 * against[2]


@pytest.fixture(scope="module")
def various(the_stage: Stage, tmp_path_factory: pytest.TempPathFactory):
    """Sprites of one-coloured individuals."""
    changed = {**COLOURS, **dict.fromkeys(HERBS, WHITE)}
    changed |= dict.fromkeys((*FIRST, *MORE_FILES), GREEN)
    assets = pictures(tmp_path_factory.mktemp("various"), changed)
    with element(the_stage, RefinedSprites, assets, DRAWN) as made:
        yield made


@pytest.mark.seldom(7, first=5)
def test_a_shadow_darkens_what_is_around_the_feet_of_what_is_near(
    stage: Stage, various: RefinedSprites
) -> None:
    def change(z: float, strength: float) -> float:
        put(various, [(20.0, 3.0, z)], [0], (0.6, 1.0))
        without = seen(stage, various, **DRAWN)
        shaded = seen(stage, various, **DRAWN, transparent__contact=strength)
        assert (shaded <= without + 1).all()
        return float((without - shaded).max())

    near, weak = change(18.0, 0.8), change(18.0, 0.3)
    assert near > 30 > weak > 8
    assert change(20.0 - WITHIN - 0.1, 0.8) == 0


@pytest.mark.seldom(7, first=5)
def test_herbs_keep_their_colours_by_day(stage: Stage, various: RefinedSprites) -> None:
    def colour(cell: int) -> float:
        put(various, [(20.0, 3.0, 18.0)], [cell], (1.0, 1.0))
        settings = {**DRAWN, "plants.crossed_within": 0.01, "transparent.upright": True}
        picture = seen(stage, various, **settings, transparent__sunward=1.0)
        return float(picture[np.abs(picture - BACKGROUND).sum(axis=2) > 60].max())

    assert colour(9) == 255 > 215 > colour(0)


def test_colours_reach_beyond_the_outline_of_a_sprite_and_alpha_does_not() -> None:
    sprite = np.zeros((16, 16, 4), np.uint8)
    sprite[6:10, 6:10] = (10, 200, 30, 255)
    out = bled(sprite)
    assert (out[..., 3] == sprite[..., 3]).all()
    assert (out[8, 4:12, :3] == (10, 200, 30)).all() and (out[8, 3] == 0).all()


def test_a_palette_keeps_alpha_and_hides_no_black_behind_it(tmp_path: Path) -> None:
    made = np.random.default_rng(1).integers(90, 160, (64, 64, 4)).astype(np.uint8)
    made[..., 3] = 255
    made[:, :32] = 0
    (tmp_path / "a.png").write_bytes(encoded(made, 256))
    image = Image.open(tmp_path / "a.png")
    assert image.mode == "P"
    read = np.asarray(image.convert("RGBA")).astype(int)
    assert (read[..., 3] == made[..., 3]).all()
    assert np.abs(read[:, :32, :3] - 124.5).max() < 12
    assert np.abs(read[:, 32:, :3] - made[:, 32:, :3]).mean() < 8


def test_the_atlas_has_the_individuals_that_are_wanted() -> None:
    best = preset("best")
    assert files(best)[:6] == FIRST and files(best)[-1] == MORE_FILES[-1]
    plain = with_settings(best, {"trees.variety": False, "deer.variety": False})
    assert files(plain)[0] == "tree_broadleaf.png" and not set(files(plain)) & set(MORE_FILES)
