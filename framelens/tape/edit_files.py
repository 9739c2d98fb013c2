"""Edits as files: JSON that people may read, keep with a lecture, and write by hand.

    {"version": 1, "edits": [
      {"call": {"name": "glFogf", "element": "fog", "pass": "main",
                "file": "landscape/elements/fog.py", "function": "enable",
                "text": "gl.glFogf(gl.GL_FOG_DENSITY, fog.density)",
                "select": ["GL_FOG_DENSITY"], "occurrence": 0},
       "argument": 1, "value": 0.3}]}

Instead of "argument" and "value" an edit may have "skip": true. "component" picks one number of a
vector or a matrix; "list" in "call" says in which display list the call is. An edit written by hand
needs only "name" and what tells its call from others: {"name": "glColor3f", "function": "draw"}.
"""

import functools
import json
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from pathlib import Path, PurePosixPath

from framelens.base.arguments import are_texts, is_number
from framelens.base.errors import InputError, short
from framelens.base.input import read_bounded
from framelens.base.output import write_whole
from framelens.base.packages import PACKAGES
from framelens.spec.spec_enumerants import BY_PNAME, GROUPS
from framelens.spec.spec_table import names
from framelens.tape.edits import Edit, Key, ListKey
from framelens.tape.safe import may_be_left_out

VERSION = 1
MOST = 1000  # chosen: edits in a file
MOST_BYTES = 4 << 20  # chosen
TEXTS = ("name", "element", "file", "function", "text")


def write(edits: Sequence[Edit], path: Path) -> None:
    """Write edits to a file, whole or not at all; InputError if that is impossible."""
    entries = {"version": VERSION, "edits": [as_json(edit) for edit in edits]}
    write_whole(path, (json.dumps(entries, indent=1) + "\n").encode())


def as_json(edit: Edit) -> dict[str, object]:
    """Return an edit as a file has it."""
    key = edit.key
    call: dict[str, object] = {name: getattr(key, name) for name in TEXTS}
    call |= {"pass": key.pass_, "select": list(key.select), "occurrence": edit.occurrence}
    if edit.shown:
        call["was"] = edit.shown
    if key.list is not None:
        call["list"] = {each.name: getattr(key.list, each.name) for each in fields(ListKey)}
    if edit.skip:
        return {"call": call, "skip": True}
    entry = {"call": call, "argument": edit.argument, "value": edit.value}
    return entry if edit.component is None else {**entry, "component": edit.component}


def read(path: Path, sources: Path | None = None) -> list[Edit]:
    """Read a file of edits; InputError names the file, the edit and what was expected.

    ``sources`` is the folder of a program that is not part of this one.
    """
    try:
        found = json.loads(read_bounded(path, MOST_BYTES))
    except InputError:
        raise
    except (ValueError, RecursionError) as error:
        raise InputError(
            "{path}: expected edits as JSON ({error})", path=path, error=error
        ) from None

    version = found.get("version") if isinstance(found, dict) else None
    if version != VERSION or not _is_number(version):
        raise InputError(
            '{path}: expected {{"version": {version}, "edits": [...]}}', path=path, version=VERSION
        )
    entries = found.get("edits")
    if not isinstance(entries, list) or len(entries) > MOST:
        raise InputError(
            '{path}: expected "edits" to be a list of at most {most}', path=path, most=MOST
        )
    return [
        _settled(_edit(entry, f"{path}: edit {number}"), sources)
        for number, entry in enumerate(entries, 1)
    ]


def _edit(entry: object, where: str) -> Edit:
    """Return the edit that an entry of a file describes."""
    if not isinstance(entry, dict) or not isinstance(entry.get("call"), dict):
        raise InputError(
            '{where}: expected {{"call": {{...}}, "argument": N, "value": ...}}', where=where
        )

    call = entry["call"]
    key, occurrence = _key(call, where), _whole(call, "occurrence", where)
    shown = call.get("was", "")
    edit = Edit(key, occurrence, shown=shown if isinstance(shown, str) else "", origin=where)

    if entry.get("skip") is True:
        if not may_be_left_out(key.name):
            raise InputError(
                "{where}: {name} cannot be left out: the program needs it",
                where=where,
                name=key.name,
            )
        return replace(edit, skip=True)

    if "value" not in entry or "argument" not in entry:
        raise InputError('{where}: expected "argument" and "value", or "skip": true', where=where)
    component = _whole(entry, "component", where) if "component" in entry else None
    value = _value(entry["value"], where)
    return replace(
        edit, argument=_whole(entry, "argument", where), value=value, component=component
    )


def _key(call: Mapping[str, object], where: str) -> Key:
    select = call.get("select", [])
    if not are_texts(select):
        raise InputError('{where}: expected "select" to be a list of names', where=where)

    texts = [_text(call, name, where) for name in TEXTS]
    name, element, file, function, text = texts
    if not name.startswith("gl"):
        raise InputError(
            "{where}: {name}: expected the name of an OpenGL function",
            where=where,
            name=short(name),
        )

    listed = None
    if "list" in call:
        inside = call["list"]
        if not isinstance(inside, dict):
            raise InputError('{where}: expected "list" to describe a display list', where=where)
        names = ("element", "file", "function", "text")
        its = {each: _text(inside, each, where) for each in names}
        listed = ListKey(**its, occurrence=_whole(inside, "occurrence", where))

    return Key(
        name, element, _text(call, "pass", where), file, function, text, tuple(select), listed
    )


def _text(entry: Mapping[str, object], name: str, where: str) -> str:
    value = entry.get(name, "")
    if not isinstance(value, str):
        raise InputError(
            '{where}: expected "{name}" of the call to be text', where=where, name=name
        )
    return value


def _whole(entry: Mapping[str, object], name: str, where: str) -> int:
    value = entry.get(name, 0)
    if type(value) is not int or not 0 <= value < 1 << 31:
        raise InputError(
            '{where}: {value}: expected "{name}" to be a number from 0 on',
            where=where,
            value=short(value),
            name=name,
        )
    return value


def _value(value: object, where: str) -> object:
    """Return a value that an argument may have; InputError for another."""
    if isinstance(value, list):
        if 0 < len(value) <= 64 and all(_is_number(each) for each in value):
            return value
    elif isinstance(value, str):
        # Asking PyOpenGL would bind it to a platform before one is chosen.
        unknown = [name.strip() for name in value.split("|") if name.strip() not in _enumerants()]
        if unknown:
            raise InputError(
                "{where}: {unknown}: no enumerant of OpenGL 1.5",
                where=where,
                unknown=short(unknown[0]),
            )
        return value
    elif isinstance(value, bool) or _is_number(value):
        return value

    raise InputError(
        "{where}: {value}: expected a number, a list of them, or GL_... names",
        where=where,
        value=short(value),
    )


@functools.cache
def _enumerants() -> frozenset[str]:
    """Return the names of all enumerants that an argument may have."""
    groups = (*GROUPS, *BY_PNAME)
    return frozenset(name for group in groups for name in names(group))


def _is_number(value: object) -> bool:
    return is_number(value) and abs(value) < 1e30


def _settled(edit: Edit, sources: Path | None) -> Edit:
    """Return an edit that also finds its call if the line's text has changed, or its file moved."""
    key = edit.key
    lines = _source_lines(key.file, sources)
    if lines is not None and key.text not in lines:
        key = key.loose()
    key = replace(key, file=_there(key.file, sources))
    if key.list is not None:
        key = replace(key, list=replace(key.list, file=_there(key.list.file, sources)))
    return replace(edit, key=key)


def _there(file: str, sources: Path | None) -> str:
    """Return a file's name; without its folders, where it is not in them any more."""
    return file if _source_lines(file, sources) is not None else PurePosixPath(file).name


@functools.cache
def _source_lines(file: str, sources: Path | None) -> frozenset[str] | None:
    """Return the lines of a source file, stripped; None if it cannot be read."""
    folder = PACKAGES[-1].folder.parent if sources is None else sources
    try:
        text = read_bounded(folder / file, MOST_BYTES).decode()
    except ValueError:  # an InputError is one, too
        return None
    return frozenset(line.strip() for line in text.splitlines())
