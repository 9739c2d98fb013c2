"""The lessons in their order, and what each file says of itself.

A lesson is a file in landscape/course/lessons. Its docstring is a title and what the program shows;
the comments after it are tags:

    # topic: transforms
    # needs: transform_order, scale          lessons that it builds on
    # picture: frame 45 after SPACE          how it is pictured; keys are pressed before frame 1
    # loop: 120 frames                       it is animated, and begins again after so many
    # keys: LEFT RIGHT SPACE                 each key that changes the picture, by GLFW's name
    # programs: grey_keys                    plain programs of its subject, in the folder programs

A plain program is there twice: NAME.py is written with GLFW, NAME_glut.py with GLUT.
"""

import ast
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from framelens.base.errors import InputError, short
from framelens.base.texts import Phrases, Texts

LESSONS = Path(__file__).resolve().parent / "lessons"
PROGRAMS = LESSONS / "programs"
SECTIONS: Phrases = ("What you see", "Why", "Change first", "Ask the class")  # of each page

LADDER: dict[str, tuple[str, ...]] = {
    "window": ("window", "keys", "mouse", "animation", "main_loop", "menu", "popup_menu"),
    "shapes": ("triangle", "viewport", "primitives", "lines", "orientation", "z_buffer"),
    "transforms": ("homogeneous", "matrices", "transform_order"),
    "meshes": ("polygon_modes", "tetrahedron"),
    "cameras": (
        *("frames", "three_turns", "pinhole", "similar_triangles", "perspective", "look_at"),
        *("teapot", "chain", "matrix_stack"),
    ),
    "light": (
        *("depth_buffer", "light_vectors", "light_model", "attenuation", "spot", "normals"),
        *("scale", "gouraud", "camera_light", "world_light", "two_lights"),
    ),
    "arrays": ("vertex_arrays", "interleaved", "mixed_faces", "display_list"),
    "textures": (
        *("blending", "generated_texture", "texture_objects", "texture_map", "textured_sphere"),
        *("quadrics", "text", "stroke_text"),
    ),
    "landscape": (
        *("height_field", "texture_units", "clip_plane", "mirror", "water", "sky_box"),
        *("billboard", "sorting", "crossed_quads", "grass", "light_map", "sprite_sheet"),
        *("ply_mesh", "overlay", "second_viewport", "fog"),
    ),
    "effects": (
        *("stencil_mirror", "planar_shadow", "one_floor", "caustics", "brightness_contrast"),
        *("mist", "quake_sky", "slerp", "squad", "sphere_map", "shadow_volume", "accumulation"),
    ),
    "voxels": (
        *("height_columns", "hidden_faces", "box_frustum", "fog_coordinate", "cube_map"),
        *("shadow_map", "projective_texture", "fresnel_cube_map", "dot3"),
    ),
    "flyover": (
        *("projection_by_hand", "bresenham", "line_clipping", "back_faces", "bezier_path"),
        *("quad_tree", "level_of_detail", "floating_horizon"),
    ),
}
TOPICS: Texts = {
    "window": "Window and events",
    "shapes": "Shapes",
    "transforms": "Transforms",
    "meshes": "Meshes",
    "cameras": "Frames and cameras",
    "light": "Light",
    "arrays": "Arrays and lists",
    "textures": "Textures",
    "landscape": "The landscape",
    "effects": "Effects",
    "voxels": "Voxels",
    "flyover": "Fly-over",
}
TAG = re.compile(r"^# (topic|needs|picture|loop|keys|programs): (.+)$", re.MULTILINE)
NAMES = tuple(name for names in LADDER.values() for name in names)


@dataclass(frozen=True)
class Lesson:
    """A lesson as its file describes it; texts are in English.

    ``about``: the paragraphs of its docstring after the title, a line each. ``pressed``: the keys
    pressed for its picture, which shows frame ``frame``. ``loop``: frames until its animation
    begins again, 0 without one. ``programs``: the plain programs that belong to it.
    """

    name: str
    title: str
    file: Path
    topic: str
    needs: tuple[str, ...]
    lines: int
    about: tuple[str, ...]
    frame: int
    pressed: tuple[str, ...]
    loop: int
    keys: tuple[str, ...]
    programs: tuple[str, ...]

    @property
    def page(self) -> Path:
        """Its page: Markdown, with the headings SECTIONS."""
        return self.file.parent / "pages" / f"{self.name}.md"

    def as_json(self) -> dict[str, object]:
        """Return what `landscape lesson --json` prints."""
        return {
            "name": self.name,
            "title": self.title,
            "file": str(self.file),
            "topic": self.topic,
            "needs": list(self.needs),
            "lines": self.lines,
            "frame": self.frame,
            "pressed": list(self.pressed),
            "programs": list(self.programs),
        }


@cache
def lesson(name: str) -> Lesson:
    """Return a lesson by its name; InputError if there is none of this name."""
    if name not in NAMES:
        raise InputError(
            "{name}: expected a lesson; `landscape lesson` lists them", name=short(name)
        )
    return read(LESSONS / f"{name}.py")


def lessons() -> list[Lesson]:
    """Return all lessons, in their order."""
    return [lesson(name) for name in NAMES]


def read(file: Path) -> Lesson:
    """Read what a lesson's file says of it; ValueError where a tag is missing, or is wrong."""
    source = file.read_text(encoding="utf-8")
    title, *about = paragraphs(ast.get_docstring(ast.parse(source)) or "")
    tags = dict(TAG.findall(source))
    missing = {"topic", "needs", "picture", "keys"} - set(tags)
    if missing:
        raise ValueError(f"{file}: lacks the tags {', '.join(sorted(missing))}")
    return described(file, source, [title, *about], tags)


def described(file: Path, source: str, texts: Sequence[str], tags: Mapping[str, str]) -> Lesson:
    """Return a lesson by what its file says: the paragraphs of its docstring, and its tags.

    InputError where a tag is wrong.
    """
    picture = re.fullmatch(r"frame (\d+)(?: after ([A-Z0-9_ ]+))?", tags["picture"])
    loop = re.fullmatch(r"(\d+) frames", tags.get("loop", "0 frames"))
    if not picture or not loop:
        raise InputError(
            "{file}: expected `# picture: frame N [after KEY ...]`, `# loop: N frames`", file=file
        )

    return Lesson(
        name=file.stem,
        title=texts[0],
        file=file,
        topic=tags["topic"],
        needs=tuple(re.findall(r"\w+", tags["needs"].replace("none", ""))),
        lines=len(source.splitlines()),
        about=tuple(texts[1:]),
        frame=int(picture[1]),
        pressed=tuple((picture[2] or "").split()),
        loop=int(loop[1]),
        keys=tuple(tags["keys"].replace("none", "").split()),
        programs=tuple(tags.get("programs", "").split()),
    )


def program_files(name: str) -> tuple[Path, Path]:
    """Return the two files of a plain program, with GLFW and with GLUT."""
    return PROGRAMS / f"{name}.py", PROGRAMS / f"{name}_glut.py"


def paragraphs(text: str) -> list[str]:
    """Return the paragraphs of a text, one line each."""
    return [" ".join(part.split()) for part in re.split(r"\n\s*\n", text.strip())]
