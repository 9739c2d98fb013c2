"""The text of the inspector: the visible rows, what is said about the chosen call, and the keys."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from framelens.gl.seam import Call
from framelens.inspector import words
from framelens.inspector.inspector import Inspector
from framelens.inspector.inspector_tree import Node
from framelens.inspector.inspector_values import Cell, cells, current
from framelens.inspector.inspector_words import arithmetic
from framelens.spec import spec
from framelens.tape.edits import Edit, Located
from framelens.tape.effects import Effect
from framelens.tape.names import element, pass_name
from framelens.tape.pixel import Row

Target = tuple[Any, ...]
ENUM_KINDS = ("enum", "mask", "boolean")
SHOWN_VALUES = 6  # chosen: variables that a call sets, of which the values are shown
CHOICES = 24  # chosen: legal enumerants shown at once, around the chosen one
MATRIX = 16


@dataclass(frozen=True)
class Span:
    """Some text in one style; ``target`` is what a click on it means.

    ``swatch`` is a colour, 0 to 255, shown before the text; ``column`` the least width of the span
    in font sizes, for columns.
    """

    text: str
    style: str = "text"
    target: Target | None = None
    swatch: tuple[int, int, int] | None = None
    column: float = 0.0


@dataclass(frozen=True)
class Line:
    """A row of the list: ``sign`` is + for one that can be opened, - for one that is open."""

    number: str
    depth: int
    sign: str
    spans: tuple[Span, ...]
    end: tuple[Span, ...] = ()
    target: Target | None = None
    chosen: bool = False


@dataclass(frozen=True)
class Block:
    """Text below the list, which flows over as many lines as it needs, after a label."""

    spans: tuple[Span, ...]
    label: str = ""


def visible(model: Inspector, count: int, language: str) -> tuple[int, list[Line]]:
    """Return the first of the rows shown, and at most ``count`` lines of the list."""
    if model.history is not None:
        first = _window(model.fragment, len(model.history), count, None)
        some = model.history[first : first + count]
        return first, [_fragment(model, row, first + k, language) for k, row in enumerate(some)]
    first = _window(model.index, len(model.rows), count, model.first)
    return first, [
        _line(model, node, first + k, language)
        for k, node in enumerate(model.rows[first : first + count])
    ]


def _window(chosen: int, total: int, count: int, first: int | None) -> int:
    start = chosen - count // 2 if first is None else first
    return max(min(start, total - count), 0)


def _line(model: Inspector, node: Node, index: int, language: str) -> Line:
    """Return a row of the tree."""
    opened = node.identity in model.opened
    sign = ("-" if opened else "+") if node.folded else ""
    chosen = node.identity == model.selected
    target = ("row", index)
    count = Span(str(node.count), "dim")
    if node.found is None:
        style = "pass" if node.kind == "pass" else "element"
        name = Span(_name(model, node, language), style)
        return Line("", node.depth, sign, (name,), (count,), target, chosen)

    edits = model.edits_of(node.found)
    args = current(node.call, edits)
    spans = code(node.name, args, "off" if model.is_off(node.found) else "")
    end = (*([count] if node.folded else []), *_marks(model.effects.get(node.place), edits))
    return Line(model.numbered(node.place), node.depth, sign, tuple(spans), end, target, chosen)


def _marks(effect: Effect | None, edits: Sequence[Edit]) -> Iterator[Span]:
    """Yield the signs at the end of a call's row: it changes nothing, it is edited."""
    if effect is not None and effect.redundant:
        yield Span("=", "redundant")
    if edits:
        yield Span("●", "edited")


def _name(model: Inspector, node: Node, language: str) -> str:
    """Return the name of a pass, or of elements; a program's own are named in its language."""
    if node.kind == "pass":
        return pass_name(language, node.name)
    return _element(model, node.name, language)


def _element(model: Inspector, names: str, language: str) -> str:
    if model.frame is not None:
        return names
    return ", ".join(element(language, name) for name in names.split(", "))


def code(name: str, args: Sequence[object], style: str = "") -> list[Span]:
    """Return a call as code, in the colours of its kinds of values."""
    spans = [Span(name, style or "name"), Span("(", style or "dim")]
    for index in range(len(args)):
        if index:
            spans.append(Span(", ", style or "dim"))
        spans.append(Span(spec.written(name, index, args), style or _style(name, index, args)))
    return [*spans, Span(")", style or "dim")]


def _style(name: str, index: int, args: Sequence[object]) -> str:
    kind = spec.kind_of(name, index, args)
    if kind in ENUM_KINDS:
        return "enum"
    return "dim" if kind in ("array", "offset", "object") else "number"


def _fragment(model: Inspector, row: Row, index: int, language: str) -> Line:
    """Return a row of the pixel's history."""
    call = row.call
    red, green, blue, _ = row.pixel.color
    style = "drawn" if row.outcome == "drawn" else "failed"
    which = "" if row.primitive is None else f"  {row.primitive}"
    spans = (
        Span("", swatch=(red, green, blue)),
        Span(words.text(language, f"inspector.{row.outcome}"), style, column=4.2),
        Span(_element(model, call.element, language), "element", column=5.0),
        Span(call.name, "name"),
        Span(which, "dim"),
    )
    chosen = index == model.fragment
    return Line(model.numbered(row.step.place), 1, "", spans, (), ("fragment", index), chosen)


def head(model: Inspector, language: str) -> list[Span]:
    """Return the title: what is listed, and whether it moves."""
    text = words.text
    if model.history is not None:
        x, y = model.pixel or (0, 0)
        where = text(language, "inspector.pixel", x=str(x), y=str(y))
        return [Span(where, "title"), Span(f"  {len(model.history)}", "dim")]
    state = text(language, "inspector.stopped" if model.stopped else "inspector.going")
    spans = [Span(text(language, "inspector.title"), "title"), Span(f"   {state}", "dim")]
    if model.edits:
        edits = words.counted(language, "inspector.edits", len(model.edits))
        spans.append(Span(f"   {edits}", "edited"))
    if model.frame is not None:
        frame = text(language, "inspector.frame", number=str(model.frame))
        spans.append(Span(f"   {frame}", "dim"))
    calls = words.counted(language, "inspector.calls", model.tree.count)
    spans.append(Span(f"   {calls}", "dim"))
    return spans


def details(model: Inspector, language: str) -> Iterator[Block]:
    """Yield what is said about the chosen row."""
    node = model.node
    if model.answer:
        for line in model.answer:
            yield Block((Span(line.strip(), "meaning" if line.startswith(" ") else "title"),))
        return
    if model.history is not None and model.history:
        yield from _history(model.history[model.fragment], language)
    if node is None:
        return
    if node.found is None:
        name = _name(model, node, language)
        about = words.counted(language, f"inspector.about_{node.kind}", node.count, name=name)
        yield Block((Span(about, "text"),))
        return
    yield from _about_call(model, node, node.found, language)


def _about_call(model: Inspector, node: Node, found: Located, language: str) -> Iterator[Block]:
    """Yield what is said about a call: itself, its meaning, its source, its arguments."""
    call = node.call
    args = current(call, model.edits_of(found))
    off = model.is_off(found)
    yield Block(tuple(code(call.name, args, "off" if off else "")))
    if off:
        yield Block((Span(words.text(language, "inspector.left_out"), "edited"),))
    if meaning := spec.explain(call.name, language):
        yield Block((Span(meaning, "text"),))
    yield Block((Span(f"{call.source}  ", "dim"), Span(call.site.text, "source")))
    if model.history is None:
        yield from _values(model, call, language)
        yield from _effect(model, node, language)


def _history(row: Row, language: str) -> Iterator[Block]:
    """Yield the arithmetic of a fragment, and what the pixel held afterwards."""
    for part in row.arithmetic.split("; "):
        yield Block((Span(arithmetic(part, language), "number"),))
    pixel = row.pixel
    far = words.text(language, "inspector.depth_value")
    depth = "" if pixel.depth is None else f"   {far} {pixel.depth:.6f}"
    stencil = "" if pixel.stencil is None else f"   stencil {pixel.stencil}"
    rgba = " ".join(map(str, pixel.color))
    yield Block((Span(f"→ RGBA {rgba}{depth}{stencil}", "dim"),))


def _values(model: Inspector, call: Call, language: str) -> Iterator[Block]:
    """Yield a block for each argument, with its cells, and then what the chosen one means."""
    now, chosen = model.cells(), model.cell
    before = {cell.place: cell for cell in cells(call)}
    for index in dict.fromkeys(cell.argument for cell in now):
        mine = [cell for cell in now if cell.argument == index]
        label = mine[0].name.split(".")[0]
        if mine[0].kind == "bit":
            known = spec.parameter(call.name, index, call.args)
            label = known.name if known else label
        spans: list[Span] = []
        for cell in mine:
            spans += _cell(cell, before.get(cell.place), cell == chosen)
        yield Block(tuple(spans), label)

    if chosen is not None:
        yield from _meaning(model, call, chosen, language)


def _meaning(model: Inspector, call: Call, chosen: Cell, language: str) -> Iterator[Block]:
    """Yield what the chosen cell of a call means, and what may stand there."""
    args = current(call, model.edits_of(model.found) if model.found else ())
    meaning = spec.explain_argument(call.name, chosen.argument, args, language)
    texts = [meaning] if meaning else []
    if chosen.kind in ("enum", "bit"):
        known = spec.parameter(call.name, chosen.argument, args)
        name = chosen.bit or str(chosen.value)
        texts.append(spec.explain_enumerant(name, language, known.of if known else ""))

    limits = _limits(chosen, language)
    if limits not in meaning:
        texts.append(limits)
    yield Block((Span(" · ".join(dict.fromkeys(filter(None, texts))), "meaning"),))
    if chosen.kind == "enum":
        yield Block(tuple(_choices(chosen)), "")


def _cell(cell: Cell, before: Cell | None, chosen: bool) -> list[Span]:
    """Return a value, and what it was where an edit has changed it."""
    changed = before is not None and before.text != cell.text
    style = "enum" if cell.kind in ("enum", "boolean", "bit") else "number"
    if cell.kind == "fixed":
        return [Span(f"{cell.text} ", "dim")]
    style = "edited" if changed else style
    target = ("cell", cell.place)
    if cell.kind == "bit":
        name = cell.bit.removeprefix("GL_").removesuffix("_BIT")
        style = style if changed or cell.text == "1" else "off"
        return [Span(name, f"{style}+chosen" if chosen else style, target), Span("  ")]
    spans = [Span(cell.text, f"{style}+chosen" if chosen else style, target)]
    if changed and before is not None:
        spans.append(Span(f" ({before.text})", "off" if cell.kind == "enum" else "dim"))
    return [*spans, Span("  ")]


def _choices(cell: Cell) -> Iterator[Span]:
    """Yield the legal enumerants around the chosen one."""
    at = cell.choices.index(cell.value) if cell.value in cell.choices else 0
    first = max(min(at - CHOICES // 2, len(cell.choices) - CHOICES), 0)
    if first:
        yield Span("… ", "dim")
    for name in cell.choices[first : first + CHOICES]:
        style = "enum+chosen" if name == cell.value else "choice"
        yield Span(name, style, ("choice", name))
        yield Span("  ")
    if first + CHOICES < len(cell.choices):
        yield Span("…", "dim")


def _limits(cell: Cell, language: str) -> str:
    """Return from where to where a number may go, "" if anywhere."""
    if cell.kind != "number":
        return ""
    low, high = (f"{end:g}" for end in (cell.low, cell.high))
    if cell.low > -1e9 and cell.high < 1e9:
        return words.text(language, "inspector.from_to", low=low, high=high)
    if cell.low > -1e9:
        return words.text(language, "inspector.from", low=low)
    return ""


def _effect(model: Inspector, node: Node, language: str) -> Iterator[Block]:
    """Yield the variables that the call sets, before and after it."""
    effect = model.effects.get(node.place)
    if effect is None:
        return
    if effect.redundant:
        yield Block((Span(words.text(language, "inspector.redundant"), "redundant"),))
    for name in list(effect.after)[:SHOWN_VALUES]:
        before, after = effect.before[name], effect.after[name]
        if isinstance(after, list) and len(after) == MATRIX:
            yield Block((Span(name, "enum"),))
            for k in range(4):
                row = f"{_numbers(before[k::4])}  →  {_numbers(after[k::4])}"
                yield Block((Span(row, "dim"),))
            continue
        values = [Span(f"{name}  ", "enum"), Span(f"{_plain(before)} → ", "dim")]
        yield Block((*values, Span(_plain(after), "dim" if before == after else "number")))


def _numbers(values: Sequence[float]) -> str:
    return " ".join(f"{value:.3g}" for value in values)


def _plain(value: object) -> str:
    """Return a variable's value in a few characters."""
    if isinstance(value, list):
        return f"({', '.join(map(_plain, value[:4]))}{', …' if len(value) > 4 else ''})"
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def foot(model: Inspector, language: str, letters: dict[str, str], few: bool = False) -> list[str]:
    """Return the message, if there is one, and the keys, or only a ``few`` of them."""
    key, values = model.said
    if "element" in values:
        values = {**values, "element": _element(model, values["element"], language)}
    message = [words.text(language, key, **values)] if key else []
    which = "inspector.keys_few" if few else "inspector.keys"
    which = which if model.history is None else "inspector.keys_pixel"
    return [*message, words.text(language, which, **letters)]
