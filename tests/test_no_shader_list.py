"""The list of entry points this program may never call is complete, and no file names any of them.

The list is made from PyOpenGL's own tables by the rules below. To write it anew:

    python tests/test_no_shader_list.py > shaders_none/forbidden.txt
"""

import ast
import importlib.util
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
LIST = ROOT / "shaders_none" / "forbidden.txt"

HEADER = """\
# Every entry point of OpenGL that creates, compiles, links, binds, feeds, runs or questions a
# shader or a program, core or extension, in PyOpenGL's tables. None is called by this program: the
# test suite traces every view and looks for them. tests/test_no_shader_list.py made this list.
#
# Not on it, because they are fixed stages with settings and not programs: texture environments and
# combiners, NV register combiners, evaluators, ATI environment bump mapping, sampler objects, the
# fragment lights of SGIX.
"""

NAMES = re.compile(
    r"""
      Shader | Program | Uniform | Subroutine | Variant   # objects, their sources and their inputs
    | VertexAttrib | Attrib(?:Array|Location|Divisor) | ActiveAttrib   # generic vertex attributes
    | VertexArray\w*(?:Attrib|Binding|VertexBuffer) | BindVertexBuffer
    | FragData | Varying | TransformFeedback              # their outputs
    | DispatchCompute | MeshTasks | PatchParameter        # what only runs through them
    | ImageTexture | ImageHandle | StorageBlock | AtomicCounter | MemoryBarrier  # their memory
    | BindBuffers?(?:Base|Range|Offset)
    """,
    re.VERBOSE,
)
"""Parts of a name that give a shader's business away, whatever the extension."""

MODULES = (
    "AMD.vertex_shader_tessellator",
    "APPLE.vertex_program_evaluators",
    "ARB.bindless_texture",
    "ARB.shader_image_load_store",
    "ARB.shader_objects",
    "ARB.shading_language_include",
    "ARB.vertex_attrib_binding",
    "ARB.vertex_program",
    "ARB.vertex_shader",
    "ATI.fragment_shader",
    "EXT.shader_image_load_store",
    "EXT.vertex_shader",
    "NV.bindless_texture",
    "NV.vertex_program",
)
"""Extensions of which every entry point is a shader's business."""


def entry_points() -> dict[str, set[str]]:
    """Return every GL function in PyOpenGL's raw tables and the modules that define it."""
    spec = importlib.util.find_spec("OpenGL")  # finds it without loading any OpenGL library
    assert spec is not None and spec.submodule_search_locations is not None
    raw = Path(spec.submodule_search_locations[0]) / "raw" / "GL"
    found: dict[str, set[str]] = {}
    for path in raw.rglob("*.py"):
        module = ".".join(path.relative_to(raw).with_suffix("").parts)
        for name in re.findall(r"^def (gl\w+)\(", path.read_text(encoding="utf-8"), re.MULTILINE):
            found.setdefault(name, set()).add(module)
    return found


def forbidden_by_rule() -> list[str]:
    """Return the sorted names that the rules above choose from PyOpenGL's tables."""
    return sorted(
        name
        for name, modules in entry_points().items()
        if NAMES.search(name) or modules.intersection(MODULES)
    )


def listed() -> list[str]:
    """Return the names in the list, as they stand there."""
    lines = LIST.read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def test_the_list_is_sorted_and_has_no_name_twice() -> None:
    assert listed() == sorted(set(listed()))


def test_every_name_exists_in_pyopengl() -> None:
    assert set(listed()) <= set(entry_points())


def test_every_name_of_a_shaders_business_is_listed() -> None:
    assert set(forbidden_by_rule()) <= set(listed()), (
        "write the list anew, see the top of this file"
    )


def test_every_rule_chooses_something() -> None:
    modules = set().union(*entry_points().values())
    assert set(MODULES) <= modules


@pytest.mark.parametrize(
    "pillar",
    [
        *("glCreateShader", "glShaderSource", "glCompileShader", "glAttachShader"),
        *("glCreateProgram", "glLinkProgram", "glUseProgram", "glUniform1i", "glUniformMatrix4fv"),
        *("glVertexAttribPointer", "glEnableVertexAttribArray", "glGetUniformLocation"),
        *("glCreateShaderObjectARB", "glUseProgramObjectARB", "glDeleteObjectARB"),
        *("glProgramStringARB", "glBindProgramARB", "glProgramEnvParameter4fARB"),
        *("glLoadProgramNV", "glTrackMatrixNV", "glBeginFragmentShaderATI", "glPassTexCoordATI"),
        *("glBeginVertexShaderEXT", "glSwizzleEXT", "glBindProgramPipeline", "glProgramBinary"),
        *("glDispatchCompute", "glDrawMeshTasksNV", "glPatchParameteri", "glSpecializeShader"),
        *("glBindImageTexture", "glShaderStorageBlockBinding", "glTransformFeedbackVaryings"),
        *("glVertexArrayAttribFormat", "glBindBufferBase", "glGetnUniformfv"),
    ],
)
def test_the_list_holds(pillar: str) -> None:
    assert pillar in listed()


@pytest.mark.parametrize(
    "stage",
    [
        *("glTexEnvi", "glActiveTexture", "glFogf", "glLightfv", "glTexGeni", "glClipPlane"),
        *("glVertexPointer", "glTexCoordPointer", "glBindBuffer", "glBlitFramebuffer"),
        *("glPushAttrib", "glPushClientAttrib", "glShadeModel", "glCombinerInputNV"),
        *("glTexParameteri", "glPointParameterf", "glEvalMesh2", "glBindFramebuffer"),
    ],
)
def test_the_fixed_stages_are_not_on_the_list(stage: str) -> None:
    assert stage in entry_points()
    assert stage not in listed()


def test_no_file_of_the_program_names_one() -> None:
    names = set(listed())
    files = sorted((ROOT / "landscape").rglob("*.py"))
    assert files
    found = {
        f"{path.relative_to(ROOT)}: {word}"
        for path in files
        for word in names.intersection(re.findall(r"\w+", path.read_text(encoding="utf-8")))
    }
    assert not found


def test_no_file_of_the_program_imports_pyopengls_shader_helpers() -> None:
    for path in sorted((ROOT / "landscape").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = [alias.name for alias in getattr(node, "names", ()) if hasattr(alias, "name")]
            names.append(getattr(node, "module", None) or "")
            assert not any(re.search(r"\bshaders$", name) for name in names), path


if __name__ == "__main__":
    print(HEADER, *forbidden_by_rule(), sep="\n")
