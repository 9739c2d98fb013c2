"""The explanations of functions, arguments and enumerants, in each language."""

import pytest
from stage import Stage

from framelens.base.texts import LANGUAGES, translator
from framelens.gl.seam import gl
from framelens.spec import spec, spec_enumerants, spec_table, spec_texts

LONGEST = 110  # characters, chosen: a line of the inspector
TABLES = ("FUNCTIONS", "ARGUMENTS", "ENUMERANTS")

EXPLAINED = (
    *("primitive", "boolean", "compare", "source_factor", "destination_factor", "blend_equation"),
    *("stencil_op", "logic_op", "cap", "client_array", "clear", "attrib", "client_attrib"),
    *("matrix_mode", "clip_plane", "shade_model", "front_face", "face", "polygon_mode"),
    *("hint_target", "hint_mode", "light", "color_material", "color_control", "fog_mode"),
    *("fog_source", "unit", "coord", "texture_target", "env_target", "env_mode", "combine_rgb"),
    *("combine_alpha", "combine_source", "operand_rgb", "operand_alpha", "min_filter"),
    *("mag_filter", "wrap", "depth_texture_mode", "compare_mode", "gen_mode_st", "accum"),
    *("list_mode", "buffer_target", "buffer_usage", "buffer_access", "render_mode"),
    *("quadric_style", "quadric_normals", "quadric_orientation"),
)
"""The groups in which each enumerant has a text, beside all properties."""


@pytest.fixture(autouse=True)
def platform(the_stage: Stage) -> None:
    """A platform is chosen before any enumerant is looked up, which imports OpenGL."""


def has_map(name: str) -> bool:
    """Return whether a capability is an evaluator, whose name says what it evaluates."""
    return name.startswith(("GL_MAP1_", "GL_MAP2_"))


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_function_and_every_argument_is_explained(language) -> None:
    for function in spec.functions().values():
        assert spec.explain(function.name, language), function.name
        for form in function.forms:
            args = [0] * len(form)
            for index, parameter in enumerate(form):
                text = spec.explain_argument(function.name, index, args, language)
                assert text, (function.name, parameter.name)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_property_and_every_value_of_the_common_groups_is_explained(language) -> None:
    for group in (*spec_enumerants.BY_PNAME, *EXPLAINED):
        for name in spec_table.names(group):
            assert has_map(name) or spec.explain_enumerant(name, language, group), (group, name)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("table", TABLES)
def test_no_text_is_too_long(table, language) -> None:
    for key, english in getattr(spec_texts, table).items():
        text = translator(language, "calls")(english, key)
        assert 0 < len(text) <= LONGEST, key
        assert text == text.strip() and not text.endswith("."), key


def test_no_text_is_for_something_that_does_not_exist() -> None:
    functions = spec.functions().values()
    assert set(spec_texts.FUNCTIONS) == {function.base for function in functions}
    used = set()
    for function in functions:
        for parameter in (parameter for form in function.forms for parameter in form):
            scopes = (f"{function.base}.", f"{function.group}.", "")
            keys = [f"{scope}{parameter.name}" for scope in scopes]
            used.add(next(key for key in keys if key in spec_texts.ARGUMENTS))
    assert used == set(spec_texts.ARGUMENTS)
    known = {*spec_enumerants.GROUPS, *spec_enumerants.BY_PNAME}
    every = {name for group in known for name in spec_table.names(group)}
    for key in spec_texts.ENUMERANTS:
        group, _, name = key.rpartition(".")
        assert name in (spec_table.names(group) if group else every), key


def test_the_value_of_a_property_is_explained_as_this_property() -> None:
    density = (gl.GL_FOG_DENSITY, 0.1)
    text = "Density of the fog, in GL_EXP and GL_EXP2"
    assert spec.explain_argument("glFogf", 1, density, "en") == text
    assert spec.explain_argument("glFogf", 0, density, "en") == "Which property is meant"
    diffuse = (gl.GL_FRONT, gl.GL_DIFFUSE, (0, 0, 0, 0))
    assert "surface" in spec.explain_argument("glMaterialfv", 2, diffuse, "en")


def test_an_enumerant_is_explained_by_the_group_that_it_belongs_to() -> None:
    index, args = 2, (gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    group = spec.parameter("glStencilOp", index, args).of
    assert "du stencil" in spec.explain_enumerant("GL_REPLACE", "fr", group)
    assert "texture" in spec.explain_enumerant("GL_REPLACE", "fr", "env_mode")
    assert spec.explain_enumerant("GL_RGB8", "en") == ""


def test_what_is_unknown_is_not_explained() -> None:
    assert spec.explain("glUseProgram", "en") == ""
    assert spec.explain_argument("glUseProgram", 0, (1,), "en") == ""
    assert spec.explain_argument("glBegin", 3, (1,), "en") == ""
