"""HTML for a cell of a notebook: no page of its own, no script, styles that stay inside it."""

from collections.abc import Iterable, Iterator, Sequence
from html import escape
from itertools import groupby
from pathlib import Path

from framelens.gl.seam import Call
from framelens.report.strip_words import counted, text
from framelens.tape.edits import as_code
from framelens.tape.names import element, pass_name
from framelens.tape.pixel import Row as PixelRow

CALLS = 60  # chosen: that a group lists; a notebook keeps its cells in its file

Row = tuple[str, str, str]
"""A call: its number, the call as code, the line of code that makes it."""

STYLE = """
.framelens { line-height: 1.45; max-width: 60rem; }
.framelens h4 { margin: .9rem 0 .2rem; font-size: 1.05em; }
.framelens p { margin: .1rem 0 .4rem; }
.framelens .quiet, .framelens figcaption { opacity: .72; }
.framelens .pictures { display: flex; flex-wrap: wrap; gap: .6rem; }
.framelens figure { margin: 0; max-width: 240px; overflow-wrap: anywhere; }
.framelens img { display: block; max-width: 100%; height: auto; }
.framelens summary { cursor: pointer; }
.framelens .calls { overflow-x: auto; }
.framelens table { border-collapse: collapse; font-size: .9em; margin: .2rem 0 .6rem; }
.framelens th, .framelens td { text-align: left; vertical-align: top;
  padding: .1rem .9rem .1rem 0; }
.framelens td { font-family: "DejaVu Sans Mono", Menlo, Consolas, monospace; }
.framelens td.words { font-family: inherit; }
.framelens i.swatch { display: inline-block; width: 1em; height: 1em; border: 1px solid #8888;
  vertical-align: -.15em; margin-right: .4em; }
"""


def fragment(lines: Iterable[str]) -> str:
    """Return lines of HTML as a part of a page, with its style."""
    inside = "\n".join(lines)
    return f'<div class="framelens"><style>{STYLE}</style>\n{inside}\n</div>'


def table(language: str, summary: str, rows: Iterable[Row], left_out: int = 0) -> Iterator[str]:
    """Yield a list of calls, to be unfolded; ``left_out`` is how many more there are."""
    words = (text(language, key) for key in ("number", "code", "source"))
    yield f"<details><summary>{escape(summary)}</summary>"
    yield '<div class="calls"><table><thead><tr>'
    yield "".join(f"<th>{word}</th>" for word in words) + "</tr></thead><tbody>"
    for row in rows:
        yield "<tr>" + "".join(f"<td>{escape(each)}</td>" for each in row) + "</tr>"
    yield "</tbody></table>"
    if left_out:
        yield f"<p>{escape(text(language, 'rest', n=left_out))}</p>"
    yield "</div></details>"


def calls(language: str, found: Sequence[Call]) -> str:
    """Return calls for a cell, in groups by pass and element, each to be unfolded."""
    lines = [f"<p>{escape(counted(language, 'calls', len(found)))}</p>"]
    for (pass_, name), group in groupby(found, key=lambda call: (call.pass_, call.element)):
        part = list(group)
        summary = text(
            language,
            "calls.part",
            pass_=pass_name(language, pass_),
            element=element(language, name),
            calls=counted(language, "calls", len(part)),
        )
        rows = [
            (str(call.number), as_code(call), f"{call.source}  {call.site.text}".rstrip())
            for call in part[:CALLS]
        ]
        lines += table(language, summary, rows, max(len(part) - CALLS, 0))
    return fragment(lines)


def pixel(language: str, name: str, place: tuple[int, int], rows: Sequence[PixelRow]) -> str:
    """Return a pixel's history for a cell: a row for each fragment that reached it."""
    title = text(language, "pixel", x=place[0], y=place[1], name=Path(name).name)
    lines = [f"<h4>{escape(title)}</h4>"]
    if not rows:
        lines.append(f"<p>{escape(text(language, 'pixel.nothing'))}</p>")
        return fragment(lines)

    keys = "number", "code", "pixel.outcome", "pixel.arithmetic", "pixel.after"
    words = "".join(f"<th>{escape(text(language, key))}</th>" for key in keys)
    lines.append(f'<div class="calls"><table><thead><tr>{words}</tr></thead><tbody>')
    lines += [_fragment_row(language, row) for row in rows]
    lines.append("</tbody></table></div>")
    return fragment(lines)


def _fragment_row(language: str, row: PixelRow) -> str:
    """Return a row of a pixel's table: what drew, what became of it, and the colour after it."""
    color = row.pixel.color
    where = f"{element(language, row.step.elements[0])}, {row.call.source}"
    swatch = f'<i class="swatch" style="background:rgb{tuple(color[:3])}"></i>'
    return (
        f"<tr><td>{escape(row.step.place)}</td>"
        f"<td>{escape(as_code(row.call))}<br>{escape(where)}</td>"
        f'<td class="words">{escape(text(language, f"outcome.{row.outcome}"))}</td>'
        f"<td>{'<br>'.join(map(escape, row.arithmetic.split('; ')))}</td>"
        f"<td>{swatch}{' '.join(map(str, color))}</td></tr>"
    )


def paragraphs(lines: Iterable[str]) -> str:
    """Return lines of text for a cell, a paragraph each."""
    return fragment(f"<p>{escape(line)}</p>" for line in lines if line)
