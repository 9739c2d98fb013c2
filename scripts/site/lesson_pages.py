"""The pages of the lessons: picture or loop, code, the lesson's own page, and its strip."""

from drawn import Drawn
from exercise_pages import of_lesson

from framelens.base.texts import translator
from landscape.commands.lesson import described, program_described
from landscape.course.ladder import LADDER, TOPICS, Lesson, lesson, lessons, program_files
from landscape.course.pages import Block, as_markdown, page


def pages(language: str, drawn: Drawn) -> dict[str, str]:
    """Return the pages by name: the list of all lessons, and one page a lesson."""
    _ = translator(language, "site", "course", "lessons")
    every = lessons()
    front = [
        f"# {_('Lessons')}",
        _(
            "Each lesson is a complete program with GLFW and PyOpenGL. "
            "`landscape lesson` lists them, `landscape lesson NAME` runs one, and with `--copy` it "
            "is copied to be changed."
        ),
    ]
    for topic in LADDER:
        named = [each for each in every if each.topic == topic]
        cards = "\n".join(_card(each, language) for each in named)
        if named:
            front += [
                f"## {_(TOPICS[topic])}",
                f"::::{{grid}} 1 2 3 3\n:gutter: 3\n\n{cards}\n::::",
            ]

    front.append("```{toctree}\n:hidden:\n\n" + "\n".join(e.name for e in every) + "\n```")
    found = {"lessons/index": "\n\n".join(front) + "\n"}
    for each in every:
        found[f"lessons/{each.name}"] = _page(each, language, drawn)
    return found


def _card(each: Lesson, language: str) -> str:
    _ = translator(language, "lessons")
    title, _colon, rest = _(each.title).partition(":")
    return (
        f":::{{grid-item-card}} {title.strip()}\n:link: {each.name}\n:link-type: doc\n"
        f":img-top: ../pictures/{each.name}.webp\n\n{rest.strip()}\n:::"
    )


def _page(each: Lesson, language: str, drawn: Drawn) -> str:
    _ = translator(language, "site", "course", "lessons")
    picture = drawn.lesson_picture(each.name, language)
    strip = drawn.strip(each.name, language)
    needs = ", ".join(title_link(lesson(name), language) for name in each.needs)
    exercises = of_lesson(each.name, language)
    parts = [
        f"# {_(each.title)}",
        f"```{{image}} ../pictures/{picture}\n:alt: {_(each.title)}\n:class: lesson-picture\n```",
        *(_(text) for text in each.about),
        *([_("Builds on {lessons}.").format(lessons=needs)] if needs else []),
        *([_("Exercise: {exercises}.").format(exercises=exercises)] if exercises else []),
        as_markdown([_folded(block, language) for block in page(each, _)]).strip(),
        f"## {_('The program')}",
        f"`landscape lesson {each.name}`",
        f"```{{code-block}} python\n:linenos:\n\n{described(each, language)}```",
        *_plain_programs(each, language),
        f"## {_('The frame, step by step')}",
        _(
            "The picture grows with each function of the program that draws; its calls and draws "
            "are counted below. `landscape strip` makes such a sheet of any program, of its frame "
            "0 unless `--frame` names another one. This is frame {frame}:"
        ).format(frame=each.frame),
        f"```sh\nlandscape lesson {each.name} --copy\n"
        f"landscape strip {each.name}.py --frame {each.frame}\n```",
        f"```{{image}} ../pictures/{strip}\n:alt: {_('The frame, step by step')}\n"
        f":target: ../_images/{strip}\n```",
    ]
    return "\n\n".join(parts) + "\n"


def _plain_programs(each: Lesson, language: str) -> list[str]:
    """Return the plain programs of a lesson, with GLFW and with GLUT side by side."""
    if not each.programs:
        return []
    _ = translator(language, "site")
    parts = [
        f"## {_('Plain programs')}",
        _(
            "Programs of this subject without texts, each with GLFW and with GLUT; `--copy` brings "
            "them along. [From GLUT to GLFW](../documents/glut.md) compares the two."
        ),
    ]
    for name in each.programs:
        forms = "".join(
            f":::{{tab-item}} {toolkit}\n`{file.name}`\n\n"
            f"```python\n{program_described(file, language)}```\n:::\n"
            for toolkit, file in zip(("GLFW", "GLUT"), program_files(name), strict=True)
        )
        parts.append(f"::::{{tab-set}}\n{forms}::::")

    return parts


def _folded(block: Block, language: str) -> Block:
    """Return a block of a page; an answer is folded, so that the question can be thought about."""
    _ = translator(language, "site", "course", "lessons")
    word, colon, answer = block.text.partition(":")
    if word.strip() not in ("Answer", "Réponse") or not colon:
        return block
    answer = answer.strip()
    return Block("", f":::{{dropdown}} {_('Answer')}\n{answer[0].upper()}{answer[1:]}\n:::")


def title_link(other: Lesson, language: str, folder: str = "") -> str:
    """Return a link to a lesson's page, with what its title says before the colon."""
    title = translator(language, "lessons")(other.title).partition(":")[0].strip()
    return f"[{title}]({folder}{other.name}.md)"
