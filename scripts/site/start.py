"""The start page."""

from framelens.base.texts import Phrases, Texts, translator

COMMANDS: Texts = {
    "make demo": "walk the island",
    "landscape lesson": "the lessons",
    "landscape lesson matrix_stack": "one of them",
}
LEAD: Phrases = (
    "An island drawn with classic fixed-function OpenGL: no shader, ever.",
    "In December 2006 a student's report showed how a handful of simple techniques make a "
    "natural landscape. It stands again, in Python: to walk, to render, and to learn from.",
)


def pages(language: str) -> dict[str, str]:
    """Return the start page."""
    _ = translator(language, "site")
    cards = (
        (
            "lessons/index",
            "matrix_stack.webp",
            _("Lessons"),
            _("Small programs, one idea each, from the first window to a terrain drawn by numpy."),
        ),
        (
            "exercises/index",
            "exercise-mirror-wanted.webp",
            _("Exercises"),
            _("Programs with a hole, and a grader that says what is missing and where."),
        ),
        (
            "documents/teaching",
            "mirror.webp",
            _("Teaching with it"),
            _("A lecture on the whole screen, and how exercises are graded."),
        ),
        (
            "figures/index",
            "fig35a.webp",
            _("Figures and fixes"),
            _("The 43 figures of 2006, their flaws, and what fixes them."),
        ),
        (
            "calls/index",
            "matrix_stack.webp",
            _("Index of calls"),
            _("Every OpenGL call, what it does, and where the code uses it."),
        ),
        (
            "scenes",
            "best_fig35e.webp",
            _("The scene"),
            _("The island as it is today, in nine views."),
        ),
        (
            "hall/index",
            "hall.webp",
            _("The great hall"),
            _("The castle's hall of classic effects, and what each of them needs."),
        ),
        (
            "voxel/index",
            "voxel_castle.webp",
            _("The island in voxels"),
            _("A terrain of cubes with reflection, refraction and shadows, pass by pass."),
        ),
        (
            "flyover/index",
            "flyover_canyon_filled.webp",
            _("The software fly-over"),
            _("A terrain without OpenGL: every line and every pixel computed in numpy."),
        ),
        (
            "documents/tools",
            "fig42a.webp",
            _("The tools"),
            _("Any call, any pixel, any state of a frame, laid open."),
        ),
        (
            "documents/built",
            "best_fig35g.webp",
            _("How it is built"),
            _("Speed measured, and assets made from code."),
        ),
    )
    commands = "\n".join(f"{c:32} # {_(COMMANDS[c])}" for c in COMMANDS)
    grid = "\n".join(
        f":::{{grid-item-card}} {title}\n:link: {page}\n:link-type: doc\n"
        f":img-top: pictures/{picture}\n\n{text}\n:::"
        for page, picture, title, text in cards
    )
    tree = "\n".join(page for page, _picture, _title, _text in cards)
    index = "\n\n".join(
        [
            "# landscape",
            f"```{{image}} pictures/best_fig35i.webp\n:alt: {_('The sea dragon in the bay')}\n"
            ":class: hero\n```",
            *(_(text) for text in LEAD),
            f"```sh\n{commands}\n```",
            f"::::{{grid}} 1 2 3 3\n:gutter: 3\n\n{grid}\n::::",
            f"```{{toctree}}\n:hidden:\n\n{tree}\n```",
        ]
    )
    views = "\n\n".join(
        f"```{{figure}} pictures/best_fig35{panel}.webp\n\n`landscape walk fig35{panel}`\n```"
        for panel in "abcdefghi"
    )
    scenes = f"# {_('The scene')}\n\n{_('The island in the preset `best`.')}\n\n{views}\n"
    return {"index": index + "\n", "scenes": scenes}
