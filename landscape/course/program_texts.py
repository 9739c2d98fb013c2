"""The texts of a lesson or an exercise, a program: its comments and docstrings, and what it shows.

Its first docstring, the task or what a lesson is about, is not among them, nor are the tags below.
"""

import ast
import io
import re
import textwrap
import tokenize
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

COLUMNS = 100  # of a line, as everywhere in the project
_TAG = re.compile(
    r"# (topic|needs|picture|loop|keys|programs|exercise|lessons|the rest|without|fmt): "
    r"|# Your code goes here"
)


@dataclass(frozen=True)
class Remark:
    """A comment or a docstring: its text on one line; its first row, the one after it, its column.

    A comment ``beside`` code takes one row; every other remark has its rows for itself.
    """

    text: str
    row: int
    end: int
    column: int
    is_docstring: bool = False
    beside: bool = False


def texts(source: str) -> list[str]:
    """Return the comments and docstrings of a program, and then the texts that it shows."""
    remarks = sorted(_remarks(source), key=lambda remark: remark.row)
    return [*(remark.text for remark in remarks), *(str(node.value) for node in _shown(source))]


def marked(source: str) -> list[tuple[str, str]]:
    """Return the texts of a module's calls _(text, context), in their order; the context or ""."""
    if "_(" not in source:
        return []
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "_":
            words = [a.value if isinstance(a, ast.Constant) else "" for a in node.args]
            text, context = (*map(str, words), "", "")[:2]
            found.append((node.lineno, node.col_offset, text, context))
    return [(text, context) for _line, _column, text, context in sorted(found) if text]


def translated(source: str, translate: Callable[[str], str]) -> str:
    """Return a program with its texts in the language of ``translate``.

    Where a line would be too long, a comment beside it moves above it, and a call's arguments to a
    line of their own.
    """
    source = _broken(_with_strings(source, translate))
    rows = source.splitlines()
    for remark in sorted(_remarks(source), key=lambda remark: remark.row, reverse=True):
        text = translate(remark.text)
        before = rows[remark.row][: remark.column]
        indent = before[: len(before) - len(before.lstrip())]
        if remark.beside:
            code = before.rstrip()
            new = [f"{code}  # {text}"]
            if len(new[0]) > COLUMNS:
                new = [*_wrapped(text, f"{indent}# "), code]
        elif remark.is_docstring:
            new = [f'{indent}"""{text}"""']
            if len(new[0]) > COLUMNS:
                new = _wrapped(f'"""{text}"""', indent)
        else:
            new = _wrapped(text, f"{indent}# ")
        if text != remark.text:
            rows[remark.row : remark.end] = new

    return "\n".join(rows) + "\n"


def lines(source: str, other: str) -> dict[int, int]:
    """Return which line of a program, from 1, is which of the same program in another language."""
    pairs = zip(ast.walk(ast.parse(source)), ast.walk(ast.parse(other)), strict=True)
    return {
        one.lineno: same.lineno
        for one, same in pairs
        if isinstance(one, ast.expr | ast.stmt) and isinstance(same, ast.expr | ast.stmt)
    }


def moved(numbers: Iterable[int], source: str, other: str) -> frozenset[int]:
    """Return which lines of the same program in another language some of its lines are.

    A comment is found by what it stands above; one that has become part of a longer text is not.
    """
    same = lines(source, other)
    rows, others = source.splitlines(), other.splitlines()
    found = set()
    for number in numbers:
        text = rows[number - 1].strip()
        before = max((n for n in same if n <= number), default=1)
        after = min((n for n in same if n >= number), default=len(rows))
        down = same.get(before, 1) - before
        up = same.get(after, len(others)) - after
        for place in (number + down, number + up):
            there = others[place - 1].strip() if 0 < place <= len(others) else ""
            if number in same or there == text or (text[:1] == "#" and there[:1] == "#"):
                found.add(place)
                break
    return frozenset(found)


def _wrapped(text: str, mark: str) -> list[str]:
    return textwrap.wrap(
        text, COLUMNS, initial_indent=mark, subsequent_indent=mark, break_on_hyphens=False
    )


def _with_strings(source: str, translate: Callable[[str], str]) -> str:
    """Return a program with the texts that it shows translated."""
    data = source.encode()  # as the columns of a syntax tree are counted in bytes
    starts = [0]
    for row in data.splitlines(keepends=True):
        starts.append(starts[-1] + len(row))
    for node in sorted(_shown(source), key=lambda node: (node.lineno, node.col_offset))[::-1]:
        begin = starts[node.lineno - 1] + node.col_offset
        end = starts[(node.end_lineno or node.lineno) - 1] + (node.end_col_offset or 0)
        text = translate(str(node.value))
        if text != node.value:
            quoted = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
            data = data[:begin] + f'"{quoted}"'.encode() + data[end:]
    return data.decode()


def _broken(source: str) -> str:
    """Return a program whose calls have their arguments on lines below where one is too long."""
    rows = source.splitlines()
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.Expr(value=ast.Call() as call, lineno=row, end_lineno=end) if end == row:
                if len(rows[row - 1]) > COLUMNS:
                    rows[row - 1] = _broken_call(source, call)
    return "\n".join(rows) + "\n"


def _broken_call(source: str, call: ast.Call) -> str:
    """Return a call with its arguments on a line below, or on one each if they are too long."""
    indent = " " * call.col_offset
    each = [ast.get_source_segment(source, a) for a in (*call.args, *call.keywords)]
    inside = [f"{indent}    {', '.join(map(str, each))}"]
    if len(inside[0]) > COLUMNS:
        inside = [f"{indent}    {argument}," for argument in each]
    name = ast.get_source_segment(source, call.func)
    return "\n".join([f"{indent}{name}(", *inside, f"{indent})"])


def _remarks(source: str) -> Iterator[Remark]:
    """Yield the comments, and the docstrings of functions."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FunctionDef) and (text := ast.get_docstring(node)):
            place = node.body[0]
            end = place.end_lineno or place.lineno
            yield Remark(" ".join(text.split()), place.lineno - 1, end, place.col_offset, True)

    block: list[tokenize.TokenInfo] = []
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type != tokenize.COMMENT or _TAG.match(token.string):
            continue
        row, column = token.start
        beside = token.line[:column].strip() != ""
        if block and (beside or block[-1].start != (row - 1, column)):
            yield _joined(block)
            block = []
        if beside:
            yield Remark(token.string[2:], row - 1, row, column, beside=True)
        else:
            block.append(token)

    if block:
        yield _joined(block)


def _joined(block: list[tokenize.TokenInfo]) -> Remark:
    text = " ".join(token.string[2:].strip() for token in block)
    row, column = block[0].start
    return Remark(text, row - 1, block[-1].start[0], column)


SHOWN = {"write": 2, "_": 0, "glfw.create_window": 2, "sys.exit": 0}
"""Functions that show a text, and which of their arguments it is."""


def _shown(source: str) -> list[ast.Constant]:
    """Return the strings that a program shows.

    They are those of a call of write(x, y, text) or _(text), the title of a window, that with which
    sys.exit ends it, and those of the table LABELS.
    """
    found: list[ast.Constant] = []
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.Call(func=function, args=arguments):
                at = SHOWN.get(ast.unparse(function))
                found += _strings(arguments[at : at + 1] if at is not None else ())
            case ast.Assign(targets=[ast.Name(id="LABELS")], value=table):
                found += _strings([table])
    return found


def _strings(nodes: Iterable[ast.AST]) -> Iterator[ast.Constant]:
    """Yield the strings that these expressions may be, or that tables hold as elements."""
    for node in nodes:
        match node:
            case ast.Constant(value=str()):
                yield node
            case ast.IfExp(body=one, orelse=other):
                yield from _strings((one, other))
            case ast.Tuple(elts=values) | ast.List(elts=values) | ast.Dict(values=values):
                yield from _strings(values)
            case ast.Subscript(value=table):
                yield from _strings([table])
