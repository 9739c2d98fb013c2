"""The trailer of the project: about a minute through all scenes, with captions.

A shot is a flight through poses, with so many seconds from one to the next. Shots are cross-faded.
Poses, times and words are chosen; the film was looked at strip by strip.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from framelens.base.texts import Texts, translator
from landscape.film.along import Software
from landscape.film.captions import Caption
from landscape.film.clip import Clip
from landscape.film.cut import Part
from landscape.film.views import Flight, Look
from landscape.flyover.environment import open_environment
from landscape.flyover.settings import Settings
from landscape.frame import Pose
from landscape.scene.scene import check_options, scene
from landscape.settings.declare import current_names, fields, with_settings

FADE, OPENING, ENDING = 1.2, 1.5, 2.0  # seconds, chosen: between shots, from black, to black
LINES, FILLED = 5.5, 5.0  # seconds, chosen: of the fly-over as lines, and with its ground
SET_OUT = 21.0  # seconds, chosen: where in its flight it is joined

TEXTS: Texts = {
    "title": "landscape",
    "title.below": "an island in classic OpenGL: no shader, ever",
    "sea": "The sea mirrors the scene",
    "sea.below": "everything is drawn a second time, upside down",
    "meadow": "24 million blades of grass",
    "meadow.below": "only those in view are drawn, each bent by the wind",
    "castle": "The castle's gate",
    "castle.below": "walk in: behind it lies another scene",
    "hall": "The great hall",
    "hall.below": "stencil mirror, planar shadows, caustics, light shafts",
    "voxel": "The same island in cubes",
    "voxel.below": "a shadow map and refraction, by the fixed pipeline alone",
    "lines": "Another land, without OpenGL",
    "lines.below": "each pixel by our own arithmetic, along a path drawn in Inkscape",
    "dusk": "One word sets the sun",
    "dusk.below": "light, fog, clouds and torches follow",
    "end": "landscape",
    "end.below": "Python, numpy and OpenGL 1.5, in software on two cores",
}


def parts(preset: str | None, changes: Mapping[str, object], language: str) -> list[Part]:
    """Return the trailer's parts; ``changes`` are settings, each for the scenes that have it.

    InputError where no scene has all of them.
    """
    check_options(preset, changes, None)
    _ = translator(language, "film")

    def caption(key: str, start: float = 1.0, end: float = 5.0, title: bool = False) -> Caption:
        below = f"{key}.below"
        return Caption(_(TEXTS[key], key), _(TEXTS[below], below), start, end, title)

    def shot(
        name: str,
        poses: Sequence[tuple[float, float | None, float, float, float]],
        spans: Sequence[float],
        kt: float = 20.0,
        **settings: object,
    ) -> Clip:
        kind = scene(name)
        own = preset if preset in kind.presets else kind.preset
        known = fields(type(kind.settings))
        given = {
            key: value
            for key, value in current_names(kind.settings, changes)[0].items()
            if key in known or key == "time"
        }
        values = kind.values(own, settings, given)
        held = set(kind.overlay)
        shown = tuple(element for element in kind.elements if element not in held)
        look = Look(name, values, shown, kt)
        return Flight(look, tuple(Pose(*pose) for pose in poses), tuple(spans))

    bay = shot(
        "island",
        [
            (2.2, 2.4, 39.5, 33.0, -7.0),
            (8.0, 1.0, 33.0, 28.0, -1.0),
            (11.2, 0.95, 31.6, 352.0, 2.0),
        ],
        [6.5, 5.0],
    )
    meadow = shot(
        "island",
        [
            (20.0, None, 24.72, 36.0, -2.0),
            (20.05, None, 24.45, 44.0, -3.0),
            (20.02, None, 24.2, 70.0, -4.0),
        ],
        [4.4, 3.4],
        kt=120.0,
    )
    castle = shot(
        "island",
        [
            (26.2, 3.5, 21.6, 20.0, -6.0),
            (28.25, 2.7, 19.6, 340.0, 6.0),
            (27.74, 2.52, 18.1, 337.0, 4.0),
        ],
        [3.5, 3.5],
        kt=200.0,
    )
    hall = shot(
        "hall",
        [
            (1.66, 0.13, 2.72, 353.5, 5.0),
            (1.62, 0.14, 2.0, 356.0, -6.0),
            (1.80, 0.20, 1.60, 328.0, 3.0),
            (1.78, 0.34, 2.3, 342.0, -7.0),
        ],
        [3.5, 3.0, 3.5],
    )
    voxel = shot(
        "voxel",
        [
            (14.6, 1.3, 32.3, 345.0, 3.0),
            (17.6, 3.0, 29.2, 4.0, -4.0),
            (22.5, 4.4, 24.4, 22.0, -8.0),
            (28.2, 3.85, 21.2, 317.0, 4.0),
        ],
        [3.0, 4.0, 4.0],
    )
    # The same seconds of one flight twice, so that the lines turn into the ground that they span.
    drawn = {"flyover.colours": "phosphor", "flyover.height": 24.0}
    lines = Software(open_environment("canyon"), with_settings(Settings(), drawn), LINES, SET_OUT)
    filled = replace(
        lines,
        settings=with_settings(lines.settings, {"flyover.mode": "filled"}),
        seconds=FILLED,
        begin=SET_OUT + LINES - FADE,
    )
    dusk = shot(
        "island",
        [
            (14.9, 1.35, 26.0, 236.0, -4.0),
            (13.2, 1.15, 27.0, 245.0, -2.0),
            (12.5, 1.0, 27.6, 248.0, 1.0),
        ],
        [5.0, 6.0],
        kt=40.0,
        time="sunset",
    )
    return [
        Part(bay, OPENING, (caption("title", 1.2, 5.6, True), caption("sea", 7.0, 11.6))),
        Part(meadow, FADE, (caption("meadow", 1.4, 5.4),)),
        Part(castle, FADE, (caption("castle", 1.4, 5.2),)),
        Part(hall, FADE, (caption("hall", 1.4, 5.8),)),
        Part(voxel, FADE, (caption("voxel", 1.4, 5.8),)),
        Part(lines, FADE, (caption("lines", 1.4, 5.2),)),
        Part(filled, FADE),
        Part(dusk, FADE, (caption("dusk", 1.4, 5.2), caption("end", 7.0, 14.0, True))),
    ]
