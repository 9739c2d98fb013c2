"""The index of every OpenGL call that lessons, exercises and scenes make, from their traces."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache

from drawn import EXERCISE, Drawn
from exercise_pages import link
from lesson_pages import title_link

from framelens.base.texts import LANGUAGES, translator
from framelens.spec import spec
from framelens.tape.names import element
from landscape.commands.lesson import described
from landscape.course import program_texts
from landscape.course.ladder import NAMES, lesson
from landscape.course.shelf import NAMES as NAMES_OF_EXERCISES

# Of a page that only the index leads to: in the sidebar, which every page has, the functions
# would take half of the site.
ORPHAN = "---\norphan: true\n---\n\n"


@dataclass
class Entry:
    """A function, without number and type: its variants, and who calls it where."""

    base: str
    group: str
    since: str
    variants: list[str] = field(default_factory=list)
    lessons: dict[str, list[int]] = field(default_factory=dict)
    exercises: set[str] = field(default_factory=set)
    elements: dict[str, list[str]] = field(default_factory=dict)

    @property
    def page(self) -> str:
        """The name of its page."""
        return f"calls/{self.base}"


def index(drawn: Drawn) -> dict[str, Entry]:
    """Return the functions called, by the names that calls have; variants share an entry."""
    entries: dict[str, Entry] = {}
    for seen in drawn.seen:
        function = spec.function(seen.name)
        if function is None:
            continue
        entry = entries.setdefault(
            function.base, Entry(function.base, function.group, function.since)
        )
        if seen.name not in entry.variants:
            entry.variants.append(seen.name)
        _file, _colon, line = seen.source.rpartition(":")
        if seen.user.startswith(f"{EXERCISE}/"):
            entry.exercises.add(seen.user.removeprefix(f"{EXERCISE}/"))
        elif "/" in seen.user:
            places = entry.elements.setdefault(seen.user, [])
            if seen.source not in places:
                places.append(seen.source)
        else:
            lines = entry.lessons.setdefault(seen.user, [])
            if int(line) not in lines:
                lines.append(int(line))

    for entry in entries.values():
        entry.variants.sort()
        entry.lessons = {n: sorted(entry.lessons[n]) for n in NAMES if n in entry.lessons}
        entry.elements = {n: sorted(entry.elements[n]) for n in sorted(entry.elements)}

    return {name: entry for entry in entries.values() for name in (entry.base, *entry.variants)}


def pages(language: str, index: Mapping[str, Entry]) -> dict[str, str]:
    """Return the pages of the index by name: the list, and one page a function."""
    _ = translator(language, "site", "course", "lessons")
    entries = sorted({entry.base: entry for entry in index.values()}.values(), key=lambda e: e.base)
    rows = [
        f"| [`{e.base}`]({e.base}.md) | {spec.explain(e.variants[0], language)} | "
        + next((title_link(lesson(n), language, "../lessons/") for n in e.lessons), "")
        + f" | {len(e.lessons)} | {len(e.exercises)} | {len(e.elements)} |"
        for e in entries
    ]
    count = _("{count} functions of OpenGL 1.x, as lessons, exercises and scenes call them.")
    front = [
        f"# {_('Index of calls')}",
        count.format(count=len(entries)),
        _("The index is made from traces: it lists what is called, not what could be."),
        "\n".join(
            [
                f"| {_('Function')} | {_('What it does')} | {_('First lesson')} | {_('Lessons')} | "
                f"{_('Exercises')} | {_('Elements')} |",
                "|---|---|---|---|---|---|",
                *rows,
            ]
        ),
    ]
    found = {"calls/index": "\n\n".join(front) + "\n"}
    for entry in entries:
        found[entry.page] = ORPHAN + _page(entry, language)
    return found


def _page(entry: Entry, language: str) -> str:
    _ = translator(language, "site", "course", "lessons")
    parts = [f"# {entry.base}", spec.explain(entry.variants[0], language) + "."]
    if entry.variants != [entry.base]:
        parts.append(
            _("Called as {names}.").format(names=", ".join(f"`{n}`" for n in entry.variants))
        )

    parts.append(_("Since OpenGL {version}.").format(version=entry.since))
    shown = next(iter(entry.lessons), "")
    if shown:
        parts += [
            f"```{{figure}} ../pictures/{shown}.webp\n:alt: {_(lesson(shown).title)}\n"
            f":target: ../lessons/{shown}.html\n:width: 320px\n\n{_(lesson(shown).title)}\n```"
        ]
        lines = []
        for name, seen in entry.lessons.items():
            numbers = [_same_lines(name, language).get(number, number) for number in seen]
            at = ", ".join(f'<a href="../lessons/{name}.html#line-{n}">{n}</a>' for n in numbers)
            which = _("line {numbers}") if len(numbers) == 1 else _("lines {numbers}")
            title = title_link(lesson(name), language, "../lessons/")
            lines.append(_("{name}: {text}").format(name=title, text=which.format(numbers=at)))
        parts += [f"## {_('In the lessons')}", _list(lines)]

    if entry.exercises:
        links = [link(name, language) for name in NAMES_OF_EXERCISES if name in entry.exercises]
        parts += [f"## {_('In the exercises')}", _list(links)]

    headings = {
        "island": _("On the island"),
        "hall": _("In the great hall"),
        "voxel": _("On the island in voxels"),
    }
    for scene, heading in headings.items():
        lines = []
        for name, places in entry.elements.items():
            if name.startswith(f"{scene}/"):
                what = element(language, name.partition("/")[2])
                at = ", ".join(f"`{place}`" for place in places)
                lines.append(_("{name}: {text}").format(name=what, text=at))
        if lines:
            parts += [f"## {heading}", _list(lines)]

    return "\n\n".join(parts) + "\n"


@cache
def _same_lines(name: str, language: str) -> dict[int, int]:
    """Return which line of a lesson is which in a language."""
    return program_texts.lines(
        *(described(lesson(name), each) for each in (LANGUAGES[0], language))
    )


def _list(lines: Iterable[str]) -> str:
    return "\n".join(f"- {line}" for line in lines)
