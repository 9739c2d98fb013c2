"""When a setting has an effect: conditions on other settings and on what is shown.

A condition is declared beside the setting as plain text: alternatives joined by " or ". Each is the
key of a setting that is on or not 0, such as ``fog.enabled``; a comparison, ``fog.mode=linear``,
``ground.units!=none`` or ``plants.species>1``; or a word without a dot: an element that is shown,
or ``walk``, as opposed to a still. ``not`` before a key or a word negates it. A setting has an
effect if all of its conditions hold. A class of elements that ignores a setting adds conditions of
its own: that nothing asks for that class.

No setting is named here: each scene brings its own. Scenes may share a group, such as the sun: what
the conditions say of settings and elements that a scene does not have is left out for it.
"""

import re
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import ClassVar, Protocol

from framelens.base.errors import Message, listed
from landscape.settings.declare import Kind, Value, current_names, fields, get

WALK = "walk"  # the word for a walk: settings of the walker do nothing in a still


class Drawer(Protocol):
    """A class of elements: the keys that ask for it, and those that it does not read."""

    asked_by: ClassVar[tuple[str, ...]]
    ignores: ClassVar[tuple[str, ...]]


class Slot(Protocol):
    """The place of an element in a scene, and the classes that may draw it."""

    @property
    def kinds(self) -> tuple[type[Drawer], ...]:
        """The classes, the finest first."""


@dataclass(frozen=True)
class Term:
    """One alternative of a condition; ``sign`` is "", "=", "!=" or ">", compared with ``value``."""

    negated: bool
    name: str
    sign: str
    value: str

    @property
    def is_setting(self) -> bool:
        """Whether this is about a setting; otherwise it is about an element or the walk."""
        return "." in self.name

    def known(self, settings: object, elements: Collection[str]) -> bool:
        """Return whether a scene of these settings and elements has what this is about."""
        if self.is_setting:
            return self.name in fields(type(settings))
        return self.name in (*elements, WALK)

    def holds(self, settings: object, shown: Collection[str]) -> bool:
        """Return whether the alternative is true of these settings and words."""
        if not self.is_setting:
            return (self.name in shown) != self.negated
        now = get(settings, self.name)
        if self.sign == ">":
            assert isinstance(now, int | float)
            return now > float(self.value)
        if self.sign:
            return (value_text(now) == self.value) == (self.sign == "=")
        return bool(now) != self.negated


@cache
def terms(condition: str) -> tuple[Term, ...]:
    """Return the alternatives of a condition."""
    found = []
    for part in condition.split(" or "):
        match = re.fullmatch(r"(not )?([\w.]+)(?:(!=|=|>)(\S+))?", part)
        assert match, f"{condition!r}: not a condition"
        negated, name, sign, value = match.groups(default="")
        found.append(Term(bool(negated), name, sign, value))
    return tuple(found)


def conditions(kind: type, key: str, slots: Iterable[Slot] = ()) -> tuple[str, ...]:
    """Return the conditions of a key of a settings class, in a scene with these slots.

    Those of its group, the class attribute ``NEEDS``, hold for each setting of the group, except
    for the one that they are about.
    """
    group = type(kind.__dataclass_fields__[key.split(".")[0]].default)  # type: ignore[attr-defined]
    every = (*getattr(group, "NEEDS", ()), *fields(kind)[key].needs)
    every += unreplaced(kind, key, slots)
    return tuple(each for each in every if all(term.name != key for term in terms(each)))


def unreplaced(kind: type, key: str, slots: Iterable[Slot]) -> tuple[str, ...]:
    """Return the conditions under which nothing draws that ignores a key.

    A class that ignores it is built if one of the keys that ask for the class differs from its
    default.
    """
    classes = [each for slot in slots for each in slot.kinds if key in each.ignores]
    asking = dict.fromkeys(name for each in classes for name in each.asked_by)
    return tuple(_at_default(kind, name) for name in asking if name in fields(kind))


def _at_default(kind: type, key: str) -> str:
    """Return the condition that a key has its default."""
    default = fields(kind)[key].default
    return f"{key}={value_text(default)}" if default else f"not {key}"


def in_words(kind: type, condition: str) -> str:
    """Return a condition in words, as in "fog.enabled on or grass shown".

    ``kind`` is the settings class; alternatives about other settings are left out.
    """
    found = []
    for term in terms(condition):
        if term.is_setting and term.name not in fields(kind):
            continue
        state = {"=": "", "!=": "not ", ">": "above "}.get(term.sign, "") + term.value
        if not term.is_setting:
            state = "not shown" if term.negated else "shown"
        elif not term.sign and fields(kind)[term.name].kind == Kind.SWITCH:
            state = "off" if term.negated else "on"
        elif not term.sign:
            state = "0" if term.negated else "not 0"
        found.append(f"{term.name} {state}")
    return " or ".join(found)


def ignored(
    settings: object,
    key: str,
    shown: Collection[str],
    elements: Collection[str],
    slots: Iterable[Slot] = (),
    unread: Collection[str] = (),
) -> Message | None:
    """Return why a setting has no effect beside the others; None if it has one.

    ``shown`` names the elements that are shown, of the scene's ``elements``, and contains WALK in a
    walk. ``slots`` and ``unread`` are the scene's.
    """
    if key in unread:
        return Message("has no effect in this scene")
    failed: list[Term] = []
    for condition in conditions(type(settings), key, slots):
        known = [term for term in terms(condition) if term.known(settings, elements)]
        if known and not any(term.holds(settings, shown) for term in known):
            failed += known
    if not failed:
        return None
    if walk := next((term for term in failed if term.name == WALK), None):
        return Message("ignored in a walk") if walk.negated else Message("ignored outside a walk")
    return Message("ignored while {reasons}", reasons=listed(_reasons(settings, failed)))


def notices(
    settings: object,
    given: Iterable[str],
    shown: Collection[str],
    elements: Collection[str],
    slots: Iterable[Slot] = (),
    unread: Collection[str] = (),
) -> dict[str, str]:
    """Return a line for each given key that has no effect beside the others, by key."""
    lines = {}
    for key in current_names(settings, dict.fromkeys(given))[0]:
        if key in fields(type(settings)) and (
            why := ignored(settings, key, shown, elements, slots, unread)
        ):
            lines[key] = f"setting {key}: {why}"
    return lines


def _reasons(settings: object, failed: Iterable[Term]) -> Iterator[Message]:
    """Yield what each of these alternatives, which do not hold, finds instead."""
    failed = list(dict.fromkeys(failed))
    for key in dict.fromkeys(term.name for term in failed if term.is_setting):
        yield _state(key, get(settings, key))

    elements = [term for term in failed if not term.is_setting]
    for term in elements:
        if term.negated:
            yield Message("{name} is shown", name=term.name)

    hidden = [term.name for term in elements if not term.negated]
    if len(hidden) > 1:
        yield Message("{names} are not shown", names=listed(hidden))
    elif hidden:
        yield Message("{name} is not shown", name=hidden[0])


def _state(key: str, value: Value) -> Message:
    """Say what value a setting has."""
    if isinstance(value, bool):
        return Message("{key} is on", key=key) if value else Message("{key} is off", key=key)
    return Message("{key} is {value}", key=key, value=value_text(value))


def value_text(value: object) -> str:
    """Return a setting's value as people write it."""
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, tuple):
        return ",".join(map(value_text, value))
    if isinstance(value, float):
        return f"{value:.0f}" if value.is_integer() else f"{value:g}"
    return str(value)
