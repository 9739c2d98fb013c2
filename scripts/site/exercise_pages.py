"""The pages of the exercises: the picture at the start, the one that is wanted, and the task."""

from framelens.base.texts import translator
from landscape.course.ladder import lesson
from landscape.course.shelf import NAMES, Exercise, exercise


def pages(language: str) -> dict[str, str]:
    """Return the pages by name: the list of all exercises, and one page an exercise."""
    _ = translator(language, "site")
    found = [exercise(name) for name in NAMES]
    cards = "\n".join(_card(each, language) for each in found)
    tree = "\n".join(NAMES)
    front = [
        f"# {_('Exercises')}",
        _(
            "Each exercise is a program with a hole. The first ones lack a line, the last ones a "
            "page. `landscape exercise check` runs what you have written, and says what is missing "
            "and in which line."
        ),
        f"::::{{grid}} 1 2 3 3\n:gutter: 3\n\n{cards}\n::::",
        f"```{{toctree}}\n:hidden:\n\n{tree}\n```",
    ]
    return {
        "exercises/index": "\n\n".join(front) + "\n",
        **{f"exercises/{each.name}": _page(each, language) for each in found},
    }


def of_lesson(name: str, language: str) -> str:
    """Return links to the exercises on a lesson, separated by commas; "" without one."""
    found = (each for each in NAMES if name in exercise(each).lessons)
    return ", ".join(link(each, language) for each in found)


def link(name: str, language: str) -> str:
    """Return a link to an exercise's page, with its title."""
    each = exercise(name)
    return f"[{each.translate.to(language)(each.title)}](../exercises/{name}.md)"


def markdown(text: str) -> str:
    """Return a plain text as Markdown, in which an asterisk is no emphasis."""
    return text.replace("*", r"\*")


def _card(each: Exercise, language: str) -> str:
    title, _colon, rest = each.translate.to(language)(each.title).partition(":")
    return (
        f":::{{grid-item-card}} {title.strip()}\n:link: {each.name}\n:link-type: doc\n"
        f":img-top: ../pictures/exercise-{each.name}-wanted.webp\n\n{rest.strip()}\n:::"
    )


def _page(each: Exercise, language: str) -> str:
    _, task = translator(language, "site"), each.translate.to(language)
    titles = translator(language, "lessons")
    lessons = ", ".join(
        f"[{titles(lesson(name).title).partition(':')[0].strip()}](../lessons/{name}.md)"
        for name in each.lessons
    )
    pictures = "\n".join(
        f":::{{grid-item-card}} {title}\n"
        f":img-bottom: ../pictures/exercise-{each.name}-{kind}.webp\n:::"
        for kind, title in (("start", _("At the start")), ("wanted", _("The picture wanted")))
    )
    parts = [
        f"# {task(each.title)}",
        f"::::{{grid}} 1 2 2 2\n:gutter: 3\n\n{pictures}\n::::",
        *(markdown(task(text)) for text in each.task),
        _("Read before: {lessons}.").format(lessons=lessons),
        f"```sh\nlandscape exercise start {each.name}\n"
        f"landscape exercise check {each.name}.py\n```",
    ]
    return "\n\n".join(parts) + "\n"
