"""A strip as one HTML file: each step with its pictures, and its calls to unfold."""

import base64
import io
from collections.abc import Iterable
from html import escape

from PIL import Image, features

from framelens.report import in_cells
from framelens.report.in_cells import table
from framelens.report.strip_page import Cell, Page, fitted, scaled
from framelens.report.strip_pictures import Legend
from framelens.report.strip_words import text
from framelens.tape.edits import as_code
from framelens.tape.strip import Group

EXACT = 64  # chosen: so many pictures are kept exactly; more are compressed (WebP)
CALLS = 500  # chosen: calls that a step lists
IN_CELL = 240  # chosen: pixels of a picture's longer side in a notebook, which keeps it in its file
QUALITY = {True: 90, False: 80}  # chosen: of WebP, on a page and in a cell

STYLE = """
:root { color-scheme: light; }
body { margin: 0 auto; padding: 2.5rem 1.5rem 4rem; max-width: 52rem; background: #fff;
  color: #1c1c1e; font: 1rem/1.5 "DejaVu Sans", "Helvetica Neue", Arial, sans-serif; }
body.wide { max-width: 104rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .4rem; }
.intro, .lines, nav { color: #5c5e62; }
nav ol { columns: 14rem; padding-left: 0; margin: 1rem 0 2rem; list-style: none; }
nav span { display: inline-block; min-width: 2em; margin-right: .5em; }
a { color: inherit; }
.legend { display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; align-items: center; margin: .3rem 0; }
.legend i { display: inline-block; width: 1em; height: 1em; margin-right: .4em;
  border: 1px solid #bec0c4; vertical-align: -.15em; print-color-adjust: exact;
  -webkit-print-color-adjust: exact; }
section { margin: 2.4rem 0 0; padding-top: 1.2rem; border-top: 1px solid #bec0c4; }
h2 { font-size: 1.2rem; margin: 0 0 .4rem; }
h2 span { color: #5c5e62; margin-right: .5em; }
.lines { margin: -.3rem 0 .7rem; }
.pictures { display: flex; flex-wrap: wrap; gap: .75rem; }
figure { margin: 0; flex: 1 1 18rem; max-width: max-content; }
img { display: block; max-width: 100%; height: auto; border: 1px solid #bec0c4; }
figcaption, .missing { color: #5c5e62; font-size: .9rem; }
.missing { display: grid; place-items: center; margin: 0; max-width: 100%; background: #eceef0; }
summary { cursor: pointer; margin: .6rem 0; }
.calls { overflow-x: auto; }
table { border-collapse: collapse; font-size: .85rem; }
th { text-align: left; }
th, td { padding: .1rem 1.2rem .1rem 0; vertical-align: top; }
td:nth-child(2) { overflow-wrap: anywhere; min-width: 16rem; }
td { font-family: "DejaVu Sans Mono", Menlo, Consolas, monospace; }
td:first-child { text-align: right; color: #5c5e62; }
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; }
  nav, details:not([open]) { display: none; }
  section { break-inside: avoid; }
  section:has(details[open]) { break-inside: auto; }
  img { max-height: 11cm; width: auto; }
}
"""


def as_html(page: Page, cells: Iterable[Cell]) -> list[bytes]:
    """Return the page, in parts: self-contained, without scripts."""
    steps, links = [], []
    for cell in cells:
        title = escape(cell.title)
        label = escape(cell.label)
        links.append(f'<li><a href="#s{cell.number}"><span>{label}</span>{title}</a></li>')
        steps.append("\n".join(_step(page, cell)).encode())

    wide = ' class="wide"' if len(page.buffers) > 1 else ""
    head = [
        "<!DOCTYPE html>",
        f'<html lang="{page.language}">',
        '<head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{escape(page.title)}</title>",
        f"<style>{STYLE}</style></head>",
        f"<body{wide}>",
        f"<h1>{escape(page.title)}</h1>",
        f'<p class="intro">{escape(page.intro)}</p>',
        *(_legend(legend) for legend in page.legends()),
        f'<nav aria-label="{escape(text(page.language, "contents"))}"><ol>',
        *links,
        "</ol></nav>",
        "<main>",
        "",
    ]
    return ["\n".join(head).encode(), *steps, b"</main>\n</body>\n</html>\n"]


def as_fragment(page: Page, cells: Iterable[Cell]) -> str:
    """Return the strip for a cell of a notebook: small pictures with their titles, no calls."""
    lines = [f'<p class="quiet">{escape(page.intro)}</p>']
    lines += [_legend(legend) for legend in page.legends()]
    lines.append('<div class="pictures">')
    for cell in cells:
        lines += _in_cell(page, cell)
    return in_cells.fragment([*lines, "</div>"])


def _in_cell(page: Page, cell: Cell) -> Iterable[str]:
    """Yield a step's pictures, with its title below them."""
    yield "<figure>"
    for name, picture in zip(page.buffers, cell.pictures, strict=True):
        small = scaled(picture, fitted(page.size, IN_CELL), sharp=name != "color")
        what = text(page.language, name)
        alt = text(page.language, "alt", what=what, number=cell.label, title=cell.title)
        source = _data(small, exact=name != "color", page=False)
        size = f'width="{small.width}" height="{small.height}"'
        yield f'<img {size} alt="{escape(alt)}" src="{source}">'
    caption = "<br>".join(escape(line) for line in (f"{cell.label}. {cell.title}", *cell.lines))
    yield f"<figcaption>{caption}</figcaption></figure>"


def _legend(legend: Legend) -> str:
    entries = "".join(
        f'<span><i class="swatch" style="background:rgb{color}"></i>{escape(text)}</span>'
        for color, text in legend.entries
    )
    return f'<div class="legend"><span>{escape(legend.heading)}</span>{entries}</div>'


def _step(page: Page, cell: Cell) -> Iterable[str]:
    yield f'<section id="s{cell.number}">'
    yield f"<h2><span>{escape(cell.label)}</span>{escape(cell.title)}</h2>"
    if cell.lines:
        yield f'<p class="lines">{"<br>".join(escape(line) for line in cell.lines)}</p>'
    yield '<div class="pictures">'
    for name, picture in zip(page.buffers, cell.pictures, strict=True):
        what = text(page.language, name)
        yield "<figure>"
        if isinstance(picture, str):
            width, height = page.size
            shape = f"width:{width}px;aspect-ratio:{width}/{height}"
            yield f'<p class="missing" style="{shape}">{escape(picture)}</p>'
        else:
            alt = text(page.language, "alt", what=what, number=cell.label, title=cell.title)
            exact = name != "color" or page.count * len(page.buffers) <= EXACT
            yield (
                f'<img width="{picture.width}" height="{picture.height}" '
                f'alt="{escape(alt)}" src="{_data(picture, exact)}">'
            )
        if len(page.buffers) > 1:
            yield f"<figcaption>{escape(what)}</figcaption>"
        yield "</figure>"

    yield "</div>"
    yield from _calls(page.language, cell.calls, cell.group)
    yield "</section>\n"


def _calls(language: str, summary: str, group: Group) -> Iterable[str]:
    """Return the lines of a step's calls, to be unfolded: number, call, line of code."""
    steps = list(group.steps)
    rows = [
        (step.place, as_code(step.call), f"{step.call.source}  {step.call.site.text}".rstrip())
        for step in steps[:CALLS]
    ]
    return table(language, summary, rows, len(steps) - len(rows))


def _data(picture: Image.Image, exact: bool, page: bool = True) -> str:
    """Return a picture as a data URI."""
    buffer, kind = io.BytesIO(), "png"
    if not exact and features.check("webp"):
        kind = "webp"
        picture.save(buffer, "WEBP", quality=QUALITY[page], method=2)
    else:
        picture.save(buffer, "PNG", compress_level=1)
    return f"data:image/{kind};base64,{base64.b64encode(buffer.getvalue()).decode()}"
