"""A lecture as one HTML file: keys, notes for the speaker, a page for each step when printed."""

import base64
from collections.abc import Iterator, Sequence
from html import escape

from framelens.base.texts import Texts, translator
from landscape.course.lecture.slides import Slide

QUALITY = 84  # chosen, of WebP
TEXTS: Texts = {
    "page.keys": "Arrows, PageDown, PageUp: next step, previous one. Home, End: first, last. "
    "N: notes. F: full screen.",
    "page.notes": "Notes",
    "page.place": "{number} of {count}",
}
ITEM = "- "

STYLE = """
:root { color-scheme: dark; }
* { box-sizing: border-box; }
body { margin: 0; background: #0f141b; color: #f2f2ec;
  font: 1rem/1.45 "DejaVu Sans", "Helvetica Neue", Arial, sans-serif; }
section { min-height: 100vh; padding: 2.2vmin 3.2vmin; display: flex; flex-direction: column;
  gap: 1.6vmin; border-bottom: 2px solid #e67e4c; }
.live section { display: none; height: 100vh; overflow: auto; border: 0; }
.live section.now { display: flex; }
header { display: flex; gap: 2rem; align-items: baseline; justify-content: space-between; }
h2 { margin: 0; font-size: max(1.3rem, 3.6vmin); line-height: 1.2; color: #ffe2b2; }
.place { color: #8e98a4; white-space: nowrap; }
p { margin: 0; font-size: max(1rem, 2.5vmin); max-width: 70em; }
.text { display: flex; flex-direction: column; gap: 1.8vmin; justify-content: center; flex: 1;
  padding: 0 4vmin; }
.text p, .text li { font-size: max(1.1rem, 3.2vmin); }
.text ul { margin: 0; padding-left: 1.2em; }
.text li::marker { color: #e67e4c; }
.shown { display: flex; flex-wrap: wrap; gap: 2vmin; flex: 1; min-height: 0; align-items: start; }
.shown figure { margin: 0; flex: 1 1 22rem; text-align: center; }
.shown img { max-width: 100%; max-height: 76vh; width: 100%; height: auto; object-fit: contain; }
.code { flex: 1 1 26rem; overflow-x: auto; font: max(.8rem, 1.75vmin)/1.5 "DejaVu Sans Mono",
  Menlo, Consolas, monospace; margin: 0; }
.code span { display: block; white-space: pre-wrap; padding: 0 .5em; color: #b0b8c2;
  border-left: 3px solid transparent; }
.code span.comment { color: #8ea396; }
.code span.marked { background: #3a3420; border-left-color: #e67e4c; color: #fffaec; }
.code i { color: #8e98a4; font-style: normal; display: inline-block; min-width: 2.6em; }
.code b { color: #ffe2b2; padding: 0 .5em; }
aside { border-top: 1px solid #3e5268; padding-top: 1vmin; color: #cdd3da; }
aside h3 { margin: 0 0 .3rem; font-size: 1rem; color: #8e98a4; }
aside p { font-size: 1rem; margin-bottom: .4rem; }
.live .shown { overflow: auto; }
.live aside { display: none; }
.live.noted aside { display: block; }
.live.noted section:has(aside) .shown img { max-height: 54vh; }
.help { position: fixed; right: 1rem; bottom: .6rem; color: #8e98a4; font-size: .8rem; }
@media print {
  @page { size: A4 landscape; margin: 12mm; }
  :root { color-scheme: light; }
  body, .live.noted, .live { background: #fff; color: #000; }
  section, .live section { display: flex; min-height: 0; height: auto; overflow: visible;
    padding: 0; border: 0; break-after: page; break-inside: avoid; }
  .help { display: none; }
  h2, .code b { color: #000; }
  .place, aside h3, .code i, aside { color: #444; }
  p, .text p, .text li { font-size: 12pt; }
  .live .shown { overflow: visible; }
  .shown img, .live.noted section:has(aside) .shown img { max-height: 105mm; width: auto; }
  .code { font-size: 8pt; }
  .code span, .code span.comment { color: #222; }
  .code span.marked { background: #f6ead0; color: #000; print-color-adjust: exact;
    -webkit-print-color-adjust: exact; }
  aside, .live aside { display: block; }
}
"""
SCRIPT = """
const body = document.body, steps = [...document.querySelectorAll("section")];
let now = Math.max(steps.findIndex(step => "#" + step.id === location.hash), 0);
function go(to) {
  now = Math.min(Math.max(to, 0), steps.length - 1);
  steps.forEach((step, n) => step.classList.toggle("now", n === now));
  history.replaceState(null, "", "#" + steps[now].id);
}
const keys = {
  ArrowRight: () => go(now + 1), ArrowDown: () => go(now + 1), PageDown: () => go(now + 1),
  " ": () => go(now + 1), ArrowLeft: () => go(now - 1), ArrowUp: () => go(now - 1),
  PageUp: () => go(now - 1), Home: () => go(0), End: () => go(steps.length - 1),
  n: () => body.classList.toggle("noted"),
  f: () => document.fullscreenElement ? document.exitFullscreen()
    : document.documentElement.requestFullscreen(),
};
document.addEventListener("keydown", event => {
  const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  act();
});
let from = null;
document.addEventListener("touchstart", event => { from = event.touches[0].clientX; });
document.addEventListener("touchend", event => {
  const way = event.changedTouches[0].clientX - from;
  if (Math.abs(way) > 60) go(now + (way < 0 ? 1 : -1));
});
addEventListener("hashchange", () => go(steps.findIndex(s => "#" + s.id === location.hash)));
body.classList.add("live");
go(now);
setTimeout(() => document.querySelector(".help").remove(), 8000);
"""


def as_html(title: str, slides: Sequence[Slide], language: str) -> bytes:
    """Return the page; without a script it shows all steps, one below the other."""
    _ = translator(language, "course")

    head = [
        "<!DOCTYPE html>",
        f'<html lang="{language}">',
        '<head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{escape(title)}</title>",
        f"<style>{STYLE}</style></head>",
        "<body>",
        "<main>",
    ]
    body = [line for slide in slides for line in _section(slide, len(slides), language)]
    foot = [
        "</main>",
        f'<div class="help">{escape(_(TEXTS["page.keys"], "page.keys"))}</div>',
        f"<script>{SCRIPT}</script>",
        "</body>",
        "</html>",
        "",
    ]

    return "\n".join([*head, *body, *foot]).encode("utf-8", "replace")


def _section(slide: Slide, count: int, language: str) -> Iterator[str]:
    _ = translator(language, "course")
    place = _(TEXTS["page.place"], "page.place").format(number=slide.number, count=count)
    yield f'<section id="s{slide.number}">'
    yield f'<header><h2>{escape(slide.title)}</h2><span class="place">{place}</span></header>'

    if slide.picture is None:
        yield '<div class="text">'
        yield from _paragraphs(slide.lines)
        yield "</div>"
    else:
        yield from _paragraphs(slide.lines)
        yield '<div class="shown">'
        height, width = slide.picture.shape[:2]
        source = base64.b64encode(slide.encoded("WEBP", QUALITY)).decode()
        yield (
            f'<figure><img width="{width}" height="{height}" alt="{escape(slide.alt)}" '
            f'src="data:image/webp;base64,{source}"></figure>'
        )
        if slide.code:
            yield from _code(slide)
        yield "</div>"

    if slide.notes:
        yield f"<aside><h3>{escape(_(TEXTS['page.notes'], 'page.notes'))}</h3>"
        yield from (f"<p>{escape(note)}</p>" for note in slide.notes)
        yield "</aside>"
    yield "</section>"


def _paragraphs(lines: Sequence[str]) -> Iterator[str]:
    """Yield lines as paragraphs, and items as lists."""
    inside = False
    for line in lines:
        if line.startswith(ITEM) != inside:
            inside = not inside
            yield "<ul>" if inside else "</ul>"
        yield f"<li>{escape(line.removeprefix(ITEM))}</li>" if inside else f"<p>{escape(line)}</p>"
    if inside:
        yield "</ul>"


def _code(slide: Slide) -> Iterator[str]:
    yield f'<div class="code"><b>{escape(slide.file)}</b>'
    for row in slide.code:
        kind = "marked" if row.marked else "comment" if row.comment else ""
        number = str(row.number) if row.number else "⋯"
        yield f'<span class="{kind}"><i>{number}</i>{escape(row.text)}</span>'
    yield "</div>"
