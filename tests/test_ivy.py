"""Single leaves of ivy: where they are, what they show, and the shade behind them."""

import numpy as np

from landscape.elements.best.castle import ivy
from landscape.elements.best.castle.growth import IVIES, leaves
from landscape.elements.best.castle.ornate_masonry import PLINTH
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.geometry.masonry import TOWER_RADIUS


def level(places: np.ndarray) -> np.ndarray:
    """Return the height of level ground."""
    return np.zeros(len(places))


def grown() -> tuple[np.ndarray, ...]:
    """Return vertices, normals, coordinates and tints of the leaves, one row for each leaf."""
    mesh, tints = ivy.single_leaves(leaves(level)[0], level)
    rows = mesh.vertices, mesh.normals, mesh.coordinates[0], tints
    return tuple(each.reshape(-1, ivy.PER_LEAF, each.shape[1]) for each in rows)


def test_leaves_lie_before_the_tower_and_few_leave_it() -> None:
    vertices, normals, _, tints = grown()
    middles = vertices.mean(axis=1)
    towers = ivy.tower_of(middles)
    assert {tuple(tower) for tower in towers.tolist()} == {tower for tower, *_ in IVIES}
    away = np.hypot(*(middles[:, [0, 2]] - towers).T) - TOWER_RADIUS
    assert away.min() > -0.006 and np.quantile(away, 0.95) < 0.07 < away.max()
    assert middles[:, 1].min() > -0.02
    assert np.allclose(np.linalg.norm(normals, axis=2), 1.0, atol=1e-5) and tints.min() > 0


def test_leaves_from_the_cache_are_those_that_were_made() -> None:
    growth = leaves(level)[0]
    made = ivy.single_leaves(growth, level)
    for _ in range(2):
        mesh, tints = ivy.remembered_leaves(growth, level)
        assert (mesh.vertices == made[0].vertices).all() and (tints == made[1]).all()
        assert (mesh.triangles == made[0].triangles).all()
    shade = zip(ivy.remembered_shade(growth), ivy.shade_on_wall(growth), strict=True)
    assert all((found == made).all() for found, made in shade)


def test_leaves_differ_in_size_and_hue_and_hang_with_their_tips_down() -> None:
    vertices, _, _, tints = grown()
    tips = vertices[:, 4] - vertices[:, 1]
    lengths = np.linalg.norm(tips, axis=1) * ivy.FILLED
    assert np.quantile(lengths, 0.9) > 2.0 * np.quantile(lengths, 0.1)
    assert (tips[:, 1] < 0).mean() > 0.85
    red = tints[:, 0, 0] / tints[:, 0, 1]
    assert red.std() > 0.04
    # Those behind others are darker.
    assert np.quantile(tints[..., 1], 0.1) < 0.4 * np.quantile(tints[..., 1], 0.9)


def test_a_leaf_shows_one_of_the_sheet_s_pictures_tip_up() -> None:
    _, _, uv, _ = grown()
    cells = np.array([ivy.COLUMNS, ivy.ROWS])
    inside = uv * cells
    assert (np.floor(inside) == np.floor(inside[:, :1])).all()
    assert (uv[:, 3:, 1] < uv[:, :3, 1]).all()
    assert len(np.unique(np.floor(inside[:, 0]), axis=0)) == ivy.COLUMNS * ivy.ROWS


def test_each_picture_is_one_leaf_with_a_clear_border_and_pale_veins() -> None:
    sheet = read_image(Assets(None).path("castle_ivy.png"))
    side = sheet.shape[0] // ivy.ROWS
    for row in range(ivy.ROWS):
        for column in range(ivy.COLUMNS):
            cell = sheet[side * row :, side * column :][:side, :side]
            alpha = cell[..., 3] > 127
            assert not alpha[[0, -1]].any() and not alpha[:, [0, -1]].any()
            assert 0.15 < alpha.mean() < 0.45
            high = np.flatnonzero(alpha.any(axis=1))
            assert alpha[high[0]].sum() < 0.2 * alpha.sum(axis=1).max(), "the tip is narrow"
            greens = cell[..., 1][alpha].astype(float)
            assert np.quantile(greens, 0.98) > 1.15 * np.quantile(greens, 0.5)


def test_the_shade_behind_ivy_fades_out_and_is_on_the_wall() -> None:
    vertices, colours, triangles = ivy.shade_on_wall(leaves(level)[0])
    assert triangles.max() < len(vertices) == len(colours)
    shade = colours[:, 3].reshape(len(IVIES) + 1, ivy.UP, ivy.AROUND)
    assert 0.5 * ivy.SHADE < shade.max() <= ivy.SHADE
    edges = shade[:, -1], shade[:, :, 0], shade[:-1, :, -1]
    assert max(float(each.max()) for each in edges) < 0.2
    on_towers = vertices[: len(IVIES) * ivy.UP * ivy.AROUND]
    towers = ivy.tower_of(on_towers)
    away = np.hypot(*(on_towers[:, [0, 2]] - towers).T) - TOWER_RADIUS
    assert 0 < away.min() < 0.002 and away.max() < 0.03


def test_ivy_in_the_corner_shades_the_gate_wall_beside_it() -> None:
    vertices, colours, _ = ivy.shade_on_wall(leaves(level)[0])
    each = ivy.UP * ivy.AROUND
    _, y, z = vertices[-each:].reshape(ivy.UP, ivy.AROUND, 3).transpose(2, 0, 1)
    shade = colours[-each:, 3].reshape(ivy.UP, ivy.AROUND)
    assert (shade[:, 0] == 0.0).all() and shade.max() > 0.3 * ivy.SHADE
    assert shade[:, 4].max() < 0.2 * shade.max()
    # Just before the wall, and before the plinth, whose top slopes.
    assert np.allclose(z[y > sum(PLINTH[1:])], -0.0015)
    assert (z[y < PLINTH[1]] < -PLINTH[2]).all() and (np.diff(z[:, 0]) >= 0.0).all()
