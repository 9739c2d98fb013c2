"""`landscape walk`: a scene in a window."""

import argparse
import os
from collections.abc import Collection, Sequence
from dataclasses import astuple, replace
from typing import TYPE_CHECKING

from framelens.base.errors import InputError, Message
from framelens.base.texts import choose, said, translator
from framelens.commands import option_values
from framelens.commands.common import edits_option
from framelens.commands.parser import language_option
from framelens.commands.reporting import notify
from landscape.commands.common import KT, WORLD, drawing_options, kt_option, pose_option
from landscape.walk.pace import FPS
from landscape.walk.thumbnails import thumbnail

if TYPE_CHECKING:
    from framelens.gl.contexts.glfw import GLFWContext
    from landscape.frame import Pose
    from landscape.scene.scene import Scene, View
    from landscape.walk.landmarks import Found
    from landscape.walk.preferences import Preferences
    from landscape.walk.title import Entry

EXAMPLE = "fig35a --fullscreen"
BEGIN = (
    "where the walk begins: a view, a fix such as R12, or a scene; without it, in a title where "
    "you choose or, with options besides --fullscreen, --lang, --fresh and --mute, at fig35e. A "
    "view of one technique, flaw or fix is walked as it is drawn, with its preset, settings, "
    "elements and wireframe"
)
ALONG = (
    "begin with a flight along the path drawn in this file (docs/environments.md); or along that "
    "of island, alps or canyon"
)
REPLAY = "replay a recorded walk; `tour` is the one that comes with the program"
FRESH = "without your preferences, which F2 in the walk changes and keeps"
MUTE = "begin without sound, as sound.muted=on; U switches it"
OF_WINDOW = ("fullscreen", "lang", "fresh", "mute")  # options with which the title is met, too
HARMLESS = (*OF_WINDOW, "view", "size", "frames", "fps", "quiet")
"""Options that cannot be found wrong once the parser has taken them, but for the view."""
# The options that are arguments of the walk.
PASSED_ON = (
    "size",
    "fullscreen",
    "record",
    "replay",
    "frames",
    "fps",
    "backend",
    "only",
    "seed",
    "wireframe",
    "quiet",
    "edits",
    "world",
    "path",
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("view", nargs="?", default="", metavar="VIEW", help=BEGIN)
    pose_option(parser)
    kt_option(parser, f"at the beginning: {KT}")

    # The window.
    parser.add_argument(
        "--size",
        type=option_values.size,
        metavar="WxH",
        help="default: 1280x720, larger on a fine display; in a replay the recorded sizes",
    )
    parser.add_argument("--fullscreen", action="store_true", help="fill the screen, as F11 does")
    language_option(parser, "language of the window")

    parser.add_argument("--fresh", action="store_true", help=FRESH)
    parser.add_argument("--mute", action="store_true", help=MUTE)

    # Files that it reads and writes.
    edits_option(parser)
    parser.add_argument(
        "--world", type=option_values.pathname, metavar="FILE", help=f"{WORLD}, loaded and saved"
    )
    parser.add_argument(
        "--record", type=option_values.pathname, metavar="FILE", help="record the walk"
    )
    parser.add_argument("--replay", type=option_values.pathname, metavar="FILE", help=REPLAY)
    parser.add_argument("--path", metavar="FILE.svg", help=ALONG)

    # How long it runs, and how finely it is drawn.
    parser.add_argument(
        "--fps",
        type=option_values.rate,
        default=FPS,
        metavar="N",
        help="frames per second to keep, by drawing less detail if need be; 0: draw all of it; "
        "default: %(default)g",
    )
    parser.add_argument(
        "--frames",
        type=option_values.count,
        metavar="N",
        help="end after N frames; default: when the window is closed",
    )
    drawing_options(
        parser,
        samples=0,
        preset="best or 2006; default: the view's own. With another one, the walk takes only the "
        "place from the view",
    )


def run(options: argparse.Namespace) -> int:
    """Walk until the user leaves; return the exit status."""
    return greet(options) if meets_title(options) else walked(options)


def meets_title(options: argparse.Namespace) -> bool:
    """Return whether a walk begins with the title: no view is named, and nothing else asked for."""
    return _asks_only_for(OF_WINDOW, options)


def opens_at_once(options: argparse.Namespace) -> bool:
    """Return whether the window can open before the scene is known: nothing can be wrong."""
    known = thumbnail(options.view) is not None
    return known and _asks_only_for(HARMLESS, options)


def _asks_only_for(names: Collection[str], options: argparse.Namespace) -> bool:
    """Return whether all options but those in ``names`` are as they are without any."""
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    usual = vars(parser.parse_args([]))
    return all(getattr(options, name) == usual[name] for name in usual if name not in names)


def _place_of(entry: "Entry") -> "tuple[str, Pose | None]":
    """Return the view, and perhaps the pose in it, that an entry of the title stands for."""
    from landscape.walk import last

    if entry.kind != "last":
        return entry.value, None
    ended = last.read()
    return (ended.view, ended.pose) if ended else ("", None)


def greet(options: argparse.Namespace) -> int:
    """Let the user choose in the title where to walk, until he leaves; return the exit status."""
    from landscape.walk import last, preferences
    from landscape.walk.opening import open_window

    keeps = not options.fresh
    wishes, wrong = preferences.read() if keeps else (preferences.Preferences(), [])
    fullscreen = options.fullscreen or wishes.fullscreen
    context = open_window(last.picture() or thumbnail("island"), None, fullscreen)
    try:
        from landscape.walk.landmarks import Found
        from landscape.walk.title import TO_TITLE, Title

        kept, damaged = Found.read() if keeps else (Found(), [])
        language = options.lang or wishes.language or choose(os.environ)
        title = Title(context, language, preferences=wishes, found=kept, tells=told, keeps=keeps)
        lines = [said(message, title.language) for message in (*wrong, *damaged)]
        notify(options, lines)
        title.note = "\n".join(lines)
        while (entry := title.run()) is not None:
            options.view, options.pose = _place_of(entry)
            options.lang = title.language
            try:
                if walked(options, context, kept) != TO_TITLE:
                    break
            except InputError as error:
                title.note = said(error, title.language)
            if keeps:
                title.heed(preferences.read()[0])
    finally:
        context.release()
    return 0


def told(name: str, language: str) -> tuple[str, ...]:
    """Return a lesson's title and the paragraphs that say what it shows, in a language."""
    from landscape.course.ladder import lesson

    chosen = lesson(name)
    translate = translator(language, "course", "lessons")
    return tuple(map(translate, (chosen.title, *chosen.about)))


def walked(
    options: argparse.Namespace,
    context: "GLFWContext | None" = None,
    kept: "Found | None" = None,
) -> int:
    """Walk from a view until the user leaves; return the exit status, or TO_TITLE.

    ``context`` is the title's window, if the walk began there, and ``kept`` what has been found.
    """
    from landscape.walk import preferences
    from landscape.walk.opening import open_window

    wishes, wrong = preferences.read() if not options.fresh else (preferences.Preferences(), [])
    _say(options, wishes, wrong)
    window = context
    if context is None and opens_at_once(options):
        fullscreen = options.fullscreen or wishes.fullscreen
        window = open_window(thumbnail(options.view), options.size, fullscreen)
    try:
        return _walked(options, wishes, window, context is not None, kept)
    finally:
        if context is None and window is not None:
            window.release()


def _begin(options: argparse.Namespace) -> "tuple[Scene, View]":
    """Return the scene and the view in which a walk begins; InputError for an impossible pose."""
    from landscape.scene.scene import find_view, scene
    from landscape.walk.recording import MAX_NUMBER

    kind, named = find_view(options.view or scene().start)
    begin = kind.as_walked(named, options.preset)
    if options.pose is not None:
        if options.path is not None:
            raise InputError("--pose: a walk along --path begins there; expected one of the two")
        if any(number and abs(number) > MAX_NUMBER for number in astuple(options.pose)):
            raise InputError("--pose: expected numbers up to {max_number:g}", max_number=MAX_NUMBER)
        begin = replace(begin, pose=options.pose)
    return kind, begin if options.kt is None else replace(begin, kt=options.kt)


def _walked(
    options: argparse.Namespace,
    wishes: "Preferences",
    window: "GLFWContext | None",
    titled: bool,
    kept: "Found | None",
) -> int:
    """Walk as :func:`walked` says, in ``window`` if it is open; ``titled``: it is the title's."""
    from landscape.commands.changes import given_changes
    from landscape.files.assets import Assets
    from landscape.walk.landmarks import Found
    from landscape.walk.session import walk

    kind, begin = _begin(options)
    if kept is None:
        kept, damaged = Found.read() if not options.fresh else (Found(), [])
        _say(options, wishes, damaged)
    given = given_changes(options, kind)
    if options.mute:
        given = {**given, "sound.muted": True}
    if options.replay is None:
        only = kind.shown(begin) if options.only is None else options.only
        standing = replace(begin, shown=())
        notices = kind.notices(standing, options.preset, given, only, walking=True)
        notify(options, list(notices.values()))

    changes = {**wishes.changes(type(kind.settings)), **given}
    return walk(
        kind,
        begin,
        settings=kind.values(kind.preset_of(begin), begin.settings, changes),
        assets=Assets(options.assets),
        language=options.lang or wishes.language,
        given=changes,
        preferences=wishes if not options.fresh else None,
        context=window,
        titled=titled,
        found=kept,
        tells=told,
        **{name: getattr(options, name) for name in PASSED_ON},
    )


def _say(
    options: argparse.Namespace, wishes: "Preferences", messages: Sequence[Message | InputError]
) -> None:
    """Print what is to be said about the user's files, in the user's language."""
    language = options.lang or wishes.language or choose(os.environ)
    notify(options, [said(message, language) for message in messages])
