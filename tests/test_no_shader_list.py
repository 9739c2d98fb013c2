"""The list of forbidden entry points is complete, and no file of the program names any of them.

The list is generated from PyOpenGL's tables by the rules below. To regenerate it:

    python tests/test_no_shader_list.py > shaders_none/forbidden.txt
"""

import ast
import importlib.util
import re
from pathlib import Path

from folded import each

ROOT = Path(__file__).resolve().parents[1]
LIST = ROOT / "shaders_none" / "forbidden.txt"

HEADER = """\
# Every OpenGL entry point in PyOpenGL's tables, core or extension, that creates, compiles, links,
# binds, supplies data to, runs or queries a shader or a program. This program calls none of them:
# the test suite traces every view and checks. tests/test_no_shader_list.py generated this list.
#
# Not listed, because they are configurable fixed stages and not programs: texture environments and
# combiners, NV register combiners, evaluators, ATI environment bump mapping, sampler objects, SGIX
# fragment lighting.
"""

NAMES = re.compile(
    r"""
      Shader | Program | Uniform | Subroutine | Variant   # objects, their sources and inputs
    | VertexAttrib | Attrib(?:Array|Location|Divisor) | ActiveAttrib   # generic vertex attributes
    | VertexArray\w*(?:Attrib|Binding|VertexBuffer) | BindVertexBuffer
    | FragData | Varying | TransformFeedback              # their outputs
    | DispatchCompute | MeshTasks | PatchParameter        # calls that only run shaders
    | ImageTexture | ImageHandle | StorageBlock | AtomicCounter | MemoryBarrier  # their memory
    | BindBuffers?(?:Base|Range|Offset)
    """,
    re.VERBOSE,
)
"""Parts of a name that mark a shader function, whatever the extension."""

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
"""Extensions whose entry points are all shader functions."""


def entry_points() -> dict[str, set[str]]:
    """Return every GL function in PyOpenGL's raw tables with the modules that define it.

    PyOpenGL 4 has the tables in a form of its own, and stubs for readers of types: they declare the
    functions of an extension in a file each, and its glInitNameOfTheExtension.
    """
    spec = importlib.util.find_spec("OpenGL")  # does not load any OpenGL library
    assert spec is not None and spec.submodule_search_locations is not None
    package = Path(spec.submodule_search_locations[0])
    raw, stubs = package / "raw" / "GL", package / "GL"
    found: dict[str, set[str]] = {}
    for folder, path in [
        *((raw, path) for path in raw.rglob("*.py")),
        *((stubs, path) for path in stubs.rglob("*.pyi") if path.name != "__init__.pyi"),
    ]:
        module = ".".join(path.relative_to(folder).with_suffix("").parts)
        text = path.read_text(encoding="utf-8")
        for name in re.findall(r"^def (gl(?!Init(?!Names))\w+)\(", text, re.MULTILINE):
            found.setdefault(name, set()).add(module)

    return found


def forbidden_by_rule() -> list[str]:
    """Return the sorted names in PyOpenGL's tables that match the rules above."""
    return sorted(
        name
        for name, modules in entry_points().items()
        if NAMES.search(name) or modules.intersection(MODULES)
    )


def listed() -> list[str]:
    """Return the names in the list, in file order."""
    lines = LIST.read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def test_the_list_is_sorted_and_has_no_duplicates() -> None:
    assert listed() == sorted(set(listed()))


def test_every_listed_name_exists_in_pyopengl() -> None:
    assert set(listed()) <= set(entry_points())


def test_every_shader_function_is_listed() -> None:
    assert set(forbidden_by_rule()) <= set(listed()), (
        "regenerate the list, see the top of this file"
    )


def test_every_extension_in_the_rules_exists() -> None:
    modules = set().union(*entry_points().values())
    assert set(MODULES) <= modules


@each(
    "name",
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
def test_the_list_contains(name: str) -> None:
    assert name in listed()


@each(
    "name",
    [
        *("glTexEnvi", "glActiveTexture", "glFogf", "glLightfv", "glTexGeni", "glClipPlane"),
        *("glVertexPointer", "glTexCoordPointer", "glBindBuffer", "glBlitFramebuffer"),
        *("glPushAttrib", "glPushClientAttrib", "glShadeModel", "glCombinerInputNV"),
        *("glTexParameteri", "glPointParameterf", "glEvalMesh2", "glBindFramebuffer"),
    ],
)
def test_fixed_function_calls_are_not_listed(name: str) -> None:
    assert name in entry_points()
    assert name not in listed()


def test_no_file_of_the_program_contains_a_listed_name() -> None:
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
        text = path.read_text(encoding="utf-8")
        for node in ast.walk(ast.parse(text)) if "shaders" in text else ():
            names = [alias.name for alias in getattr(node, "names", ()) if hasattr(alias, "name")]
            names.append(getattr(node, "module", None) or "")
            assert not any(re.search(r"\bshaders$", name) for name in names), path


if __name__ == "__main__":
    print(HEADER, *forbidden_by_rule(), sep="\n")
