"""A lecture as PDF, by Typst: slides, or a handout with the notes.

It is tagged, names its language, has an alternative text for each picture (PDF/UA-1), and the same
bytes each time. The fonts are the program's own.
"""

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from tempfile import TemporaryDirectory

from framelens.base.errors import InputError, short
from framelens.base.installation import how_to_add
from framelens.base.packages import FRAMELENS
from landscape.course.lecture.slides import Slide

TEMPLATE = Path(__file__).parent / "pages.typ"
QUALITY = 90  # chosen, of JPEG


def check_typst() -> None:
    """Raise InputError if Typst is not installed."""
    try:
        import typst  # noqa: F401
    except ImportError:
        raise InputError(
            "--out: a PDF needs the Python package typst: {command}",
            command=how_to_add("typst", extra="handout"),
        ) from None


def as_pdf(title: str, slides: Sequence[Slide], language: str, paper: str) -> bytes:
    """Return the pages as PDF, on one of the PAPERS of plan.py."""
    import typst

    with TemporaryDirectory(prefix="landscape-") as name:
        folder = Path(name)
        steps = [_written(slide, folder) for slide in slides]
        content = {"title": title, "language": language, "paper": paper, "steps": steps}
        (folder / "lecture.json").write_text(json.dumps(content), encoding="utf-8")
        (folder / TEMPLATE.name).write_bytes(TEMPLATE.read_bytes())
        try:
            made: bytes = typst.compile(
                str(folder / TEMPLATE.name),
                root=name,
                font_paths=[str(FRAMELENS.folder / "fonts")],
                ignore_system_fonts=True,
                pdf_standards="ua-1",
            )
        except RuntimeError as error:
            raise InputError("--out: typst: {error}", error=short(str(error))) from None
        return made


def _written(slide: Slide, folder: Path) -> dict[str, object]:
    """Write the picture of a slide into a folder; return what the template reads."""
    picture = None
    if slide.picture is not None:
        picture = f"{slide.number}.jpg"
        (folder / picture).write_bytes(slide.encoded("JPEG", QUALITY))
    return {
        "number": slide.number,
        "title": slide.title,
        "lines": list(slide.lines),
        "picture": picture,
        "alt": slide.alt,
        "file": slide.file,
        "code": [asdict(row) for row in slide.code],
        "notes": list(slide.notes),
    }
