"""From the words of the command line to a film: views, a drawn path, a recorded walk, the tour."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import Path

from framelens.base.errors import InputError
from landscape.files.assets import Assets
from landscape.film.along import Along, Software
from landscape.film.cut import Film, Part
from landscape.film.replay import Recorded
from landscape.film.rig import AROUND, FOV, ONE
from landscape.film.stage import Drawing
from landscape.film.views import Flight, Look, Still, spans
from landscape.flyover.environment import NAMES, open_environment
from landscape.flyover.settings import BEST, PRESETS, Settings
from landscape.frame import Pose
from landscape.scene.scene import SCENES, Scene, View, find_view, placed, scene
from landscape.settings.declare import preset, with_settings
from landscape.walk.recording import read

MOMENT, GLANCE = 5.0, 3.0  # chosen: seconds of a single view, and of one between two cuts
MOST_FRAMES = 500_000  # chosen: more than four hours
TOUR = "tour"
SOFTWARE = "flyover"  # of --scene: the terrain of the drawing itself, drawn without OpenGL
FPS_DENOMINATOR = 1001  # of 24000/1001 and such


@dataclass(frozen=True)
class Wanted:
    """The user's wishes besides the sources; see `landscape film --help`."""

    drawing: Drawing
    fps: float = 30.0
    seconds: float | None = None
    scene: str = ""
    preset: str | None = None
    changes: Mapping[str, object] = field(default_factory=dict)
    only: Sequence[str] | None = None
    kt: float | None = None
    wireframe: bool = False
    language: str = "en"
    sound: bool = False

    @property
    def rate(self) -> Fraction:
        """The frames per second as a fraction."""
        return Fraction(self.fps).limit_denominator(FPS_DENOMINATOR)


def is_recording(word: str) -> bool:
    """Return whether a source is a recorded walk and not a view."""
    known = word in SCENES or any(scene(name).named(word) for name in SCENES)
    return word.endswith(".jsonl") or (not known and os.path.exists(word))


def is_drawing(word: str, wanted: Wanted) -> bool:
    """Return whether a source is a path drawn in Inkscape; of the fly-over, also a shipped one."""
    return word.lower().endswith(".svg") or (wanted.scene == SOFTWARE and word in NAMES)


def places(words: Sequence[str], wanted: Wanted) -> list[tuple[Scene, View]]:
    """Return the views among the sources, with their scenes; InputError for words that are none.

    Of a drawn path, it is the view in which its scene starts.
    """
    found = []
    for word in words:
        if is_drawing(word, wanted):
            if wanted.scene != SOFTWARE:
                kind = scene(wanted.scene)
                found.append((kind, kind.views[kind.start]))
        elif word != TOUR and not is_recording(word):
            found.append(find_view(word))
    return found


def film_of(words: Sequence[str], wanted: Wanted) -> Film:
    """Return the film of one or more sources; InputError where there is none.

    Nothing is opened yet: a scene that cannot be is found out when it is drawn.
    """
    _check(words, wanted)
    word = words[0]
    ending = 0.0
    if word == TOUR:
        from landscape.film.tour import ENDING, parts

        if wanted.seconds is not None or wanted.kt is not None or wanted.only is not None:
            raise InputError("tour: its length, times and elements are its own")
        found, ending = parts(wanted.preset, wanted.changes, wanted.language), ENDING
    elif is_drawing(word, wanted):
        found = [_along(word, wanted)]
    elif is_recording(word):
        found = [Part(_recorded(Path(word), wanted))]
    else:
        found = _through(words, wanted)
    film = Film(tuple(found), wanted.drawing, wanted.rate, ending, wanted.sound)
    if film.frames > MOST_FRAMES:
        raise InputError(
            "{word}: {frames} frames, expected at most {most_frames}",
            word=word,
            frames=film.frames,
            most_frames=MOST_FRAMES,
        )
    return film


def look_at(kind: Scene, view: View, wanted: Wanted, flown: bool = False) -> Look:
    """Return how a view is looked at; ``flown``: without what only a walker holds."""
    preset = kind.preset_of(view) if wanted.preset is None else wanted.preset
    changes = wanted.changes
    if wanted.drawing.rig == AROUND:
        changes = {**changes, "camera.fov": FOV}  # that of a face
    values = kind.values(preset, view.settings, changes)
    shown = kind.shown(view, wanted.only, values)
    flown = flown or wanted.drawing.rig != ONE
    if flown and wanted.only is None:
        shown = tuple(name for name in shown if name not in kind.overlay)
    kt = view.kt if wanted.kt is None else wanted.kt
    wireframe = wanted.wireframe or view.wireframe
    return Look(kind.name, values, shown, kt, wireframe, 0 if flown else view.stroke)


def _through(words: Sequence[str], wanted: Wanted) -> list[Part]:
    """Return the clips of named views: flights between those that are drawn alike, and cuts."""
    if len(words) == 1:
        kind, view = find_view(words[0])
        still = Still(look_at(kind, view, wanted), view.pose, wanted.seconds or MOMENT)
        return [Part(still)]

    found: list[Still | Flight] = []
    for look, views in _drawn_alike(words, wanted):
        poses = tuple(view.pose for view in views)
        if len(poses) == 1:
            found.append(Still(look, poses[0], GLANCE))
        else:
            found.append(Flight(look, poses, spans(_high(look, poses), look.values.walk.speed)))

    if wanted.seconds is not None:
        scale = wanted.seconds / sum(clip.seconds for clip in found)
        found = [clip.lasting(scale * clip.seconds) for clip in found]
    return [Part(clip) for clip in found]


def _check(words: Sequence[str], wanted: Wanted) -> None:
    """Raise InputError for sources, rigs and scenes that do not go together."""
    word = words[0]
    alone = [
        word for word in words if word == TOUR or is_drawing(word, wanted) or is_recording(word)
    ]
    if alone and len(words) > 1:
        raise InputError(
            "{alone}: expected to be the only source; only views can be several", alone=alone[0]
        )
    if wanted.drawing.rig != ONE and (alone and not is_drawing(word, wanted)):
        raise InputError(
            "--camera {rig}: expected views or a path, not {word}",
            rig=wanted.drawing.rig,
            word=word,
        )
    if wanted.drawing.rig != ONE and wanted.scene == SOFTWARE:
        raise InputError("--camera {rig}: not over --scene flyover", rig=wanted.drawing.rig)
    if wanted.scene and not is_drawing(word, wanted):
        raise InputError("--scene {scene}: only a path has none of its own", scene=wanted.scene)


def _drawn_alike(words: Sequence[str], wanted: Wanted) -> list[tuple[Look, list[View]]]:
    """Return views in groups of neighbours that are drawn alike but for the time."""
    groups: list[tuple[Look, list[View]]] = []
    for kind, view in map(find_view, words):
        look = look_at(kind, view, wanted, flown=True)
        if groups and replace(groups[-1][0], kt=look.kt) == look:
            groups[-1][1].append(view)
        else:
            groups.append((look, [view]))
    return groups


def _high(look: Look, poses: tuple[Pose, ...]) -> tuple[Pose, ...]:
    """Return poses with heights, as far as these are known without opening the scene."""
    if all(pose.y is not None for pose in poses):
        return poses
    terrain = scene(look.scene).terrain(look.values, Assets())
    return tuple(placed(pose, terrain, look.values.walk.eye) for pose in poses)


def _along(word: str, wanted: Wanted) -> Part:
    """Return the clip of a drawn path."""
    environment = open_environment(word)
    seconds = wanted.seconds
    if wanted.scene == SOFTWARE:
        chosen = preset(Settings(), PRESETS, wanted.preset or BEST)
        settings = with_settings(chosen, wanted.changes)
        length = environment.duration(settings.flyover)
        if seconds is not None:
            faster = {"flyover.speed": settings.flyover.speed * length / seconds}
            settings = with_settings(settings, faster)
        return Part(Software(environment, settings, seconds or length))
    kind = scene(wanted.scene)
    look = look_at(kind, kind.views[kind.start], wanted, flown=True)
    speed = Settings().flyover.speed
    if seconds is not None:
        speed = environment.path.length / seconds
    return Part(Along(environment, look, seconds or environment.path.length / speed, speed))


def _recorded(path: Path, wanted: Wanted) -> Recorded:
    given = {
        "--preset": wanted.preset,
        "--set": wanted.changes,
        "--only": wanted.only,
        "--kt": wanted.kt,
    }
    for option, value in given.items():
        if value:
            raise InputError(
                "{option}: {path} is a recording, which has its own", option=option, path=path
            )
    plan, ticks = read(path)
    seconds = sum(tick.seconds for tick in ticks)
    if wanted.seconds is not None:
        seconds = min(seconds, wanted.seconds)
    if wanted.wireframe:
        plan = replace(plan, wireframe=True)
    return Recorded(plan, tuple(ticks), seconds)
