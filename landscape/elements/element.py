"""The parts of a scene: elements, the slots that they fill, and the owner of what was built.

An :class:`Element` draws one thing by one technique. A :class:`Slot` is the place in a scene that
one of several classes fills, the finest first: each says itself whether the settings ask for it.
:class:`Elements` builds them, draws them, passes settings on to them, and releases them.
"""

from collections.abc import Callable, Collection, Hashable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import ClassVar, Generic, Self, TypeVar, cast

from framelens.gl.seam import begin_pass, drawing
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.settings.declare import differs

Values = TypeVar("Values")  # the settings of a scene, or those of its groups that an element reads
Kind = TypeVar("Kind")


@dataclass(frozen=True)
class Site(Generic[Values]):
    """The material of an element: settings, files and seed, and the elements built before it.

    ``only`` names the elements that may be shown.
    """

    settings: Values
    assets: Assets
    seed: int
    only: frozenset[str]
    elements: "Elements[Values]"


class Element(Generic[Values]):
    """One thing in a scene, drawn by one technique.

    ``asked_by`` are the keys that ask for this class: one of them must differ from its default, the
    value of 2006. ``ignores`` are keys of its groups that it does not read.
    """

    asked_by: ClassVar[tuple[str, ...]] = ()
    ignores: ClassVar[tuple[str, ...]] = ()
    settings: Values

    @classmethod
    def serves(cls, settings: Values) -> bool:
        """Return whether this class draws what the settings ask for."""
        return not cls.asked_by or any(differs(settings, key) for key in cls.asked_by)

    @classmethod
    def built_from(cls, settings: Values) -> Hashable:
        """Return what the constructor uses of the settings; all else is read at each draw."""
        return ()

    @classmethod
    def build(cls, site: Site[Values]) -> Self:
        """Build the element; InputError names a file that cannot be used."""
        return cast(Callable[..., Self], cls)(site.settings, site.assets)

    def take(self, settings: Values) -> None:
        """Take other settings, from which nothing else would be built."""
        self.settings = settings

    def draw(self, frame: Frame) -> None:
        """Draw it; the OpenGL state is afterwards as it was before."""
        raise NotImplementedError

    def release(self) -> None:
        """Delete what was made in OpenGL; may be called twice."""


@dataclass(frozen=True)
class Slot(Generic[Values]):
    """The place of an element in a scene.

    ``kinds`` are the classes that may fill it, the finest first; the first that serves is built, if
    any does. ``shown_by`` names the elements, as users know them, of which it is a part: the slot's
    name, unless others are given. It is built if one of ``built_for`` may be shown (``shown_by``
    unless others are given), and all of ``beside``; or ``always``. Others are built from a
    ``base``, so it is never built again alone. ``build`` is for what only the scene knows.
    """

    name: str
    kinds: tuple[type[Element[Values]], ...]
    shown_by: tuple[str, ...] = ()
    built_for: tuple[str, ...] = ()
    beside: tuple[str, ...] = ()
    always: bool = False
    base: bool = False
    build: Callable[[Site[Values]], Element[Values]] | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the elements that show it."""
        return self.shown_by or (self.name,)

    def kind(self, settings: Values) -> type[Element[Values]] | None:
        """Return the class that draws what the settings ask for; None if nothing is to be drawn."""
        return next((kind for kind in self.kinds if kind.serves(settings)), None)

    def may_show(self, only: Collection[str]) -> bool:
        """Return whether it is to be built where only these elements may be shown."""
        if self.always:
            return True
        needed = self.built_for or self.names
        return any(name in only for name in needed) and all(name in only for name in self.beside)


_watchers: list[Callable[[str], None]] = []


@contextmanager
def watched(tell: Callable[[str], None]) -> Iterator[None]:
    """Let ``tell`` know the name of each slot that the block is about to fill."""
    _watchers.append(tell)
    try:
        yield
    finally:
        _watchers.remove(tell)


class Elements(Generic[Values]):
    """The elements of an open scene, by slot; ``shown`` may be changed between frames."""

    def __init__(self, settings: Values, assets: Assets, seed: int, only: Collection[str]) -> None:
        """Build nothing yet; ``only`` names the elements that may be shown."""
        self.shown = set(only)
        self._site = Site(settings, assets, seed, frozenset(only), self)
        self._slots: dict[str, Slot[Values]] = {}
        self._elements: dict[str, Element[Values] | None] = {}
        self._by_kind: dict[type, object] = {}

    @contextmanager
    def building(self) -> Iterator[None]:
        """Let the block build the scene; if it fails, release what has been built."""
        begin_pass("setup")
        try:
            yield
        except BaseException:
            self.release()
            raise

    def build(self, *slots: Slot[Values]) -> None:
        """Fill slots, in this order."""
        for slot in slots:
            for tell in _watchers:
                tell(slot.name)
            self._slots[slot.name] = slot
            self._elements[slot.name] = self._filled(slot, self._site)
            self._by_kind.clear()

    def _kind(self, slot: Slot[Values], settings: Values) -> type[Element[Values]] | None:
        """Return the class that is to fill a slot, None if it is to stay empty."""
        return slot.kind(settings) if slot.may_show(self._site.only) else None

    def _filled(self, slot: Slot[Values], site: Site[Values]) -> Element[Values] | None:
        """Build what is to fill a slot, if anything is."""
        kind = self._kind(slot, site.settings)
        if kind is None:
            return None
        with drawing(*(slot.built_for or slot.names)):
            return slot.build(site) if slot.build else kind.build(site)

    def _stays(self, slot: Slot[Values], settings: Values) -> bool:
        """Return whether what fills a slot, or its emptiness, also serves other settings."""
        element = self._elements[slot.name]
        kind = self._kind(slot, settings)
        if element is None or kind is None:
            return element is kind
        return type(element) is kind and (
            kind.built_from(self._site.settings) == kind.built_from(settings)
        )

    def apply(self, settings: Values) -> Collection[str] | None:
        """Apply settings, building again only what was built from what has changed.

        Return the names of the slots that were filled again. None, changing nothing, if a base
        would be one of them. Whatever is raised, nothing has changed then either.
        """
        former = self._site.settings
        if not all(self._stays(slot, settings) for slot in self._slots.values() if slot.base):
            return None
        site = replace(self._site, settings=settings)
        begin_pass("setup")
        taken: list[Element[Values]] = []
        filled: dict[str, Element[Values] | None] = {}
        try:
            for slot in self._slots.values():
                element = self._elements[slot.name]
                if not self._stays(slot, settings):
                    filled[slot.name] = self._filled(slot, site)
                elif element is not None:
                    taken.append(element)
                    element.take(settings)
        except BaseException:
            _release(filled.values())
            for element in taken:
                element.take(former)
            raise

        replaced = [self._elements[name] for name in filled]
        self._elements |= filled
        self._by_kind.clear()
        self._site = site
        _release(replaced)
        return filled.keys()

    def get(self, kind: type[Kind]) -> Kind | None:
        """Return the first element of a class; None if none was built."""
        if kind not in self._by_kind:
            every = (each for each in self._elements.values() if isinstance(each, kind))
            self._by_kind[kind] = next(every, None)
        element = self._by_kind[kind]
        return element if isinstance(element, kind) else None

    def __getitem__(self, kind: type[Kind]) -> Kind:
        """Return the first element of a class; LookupError if none was built."""
        element = self.get(kind)
        if element is None:
            raise LookupError(f"{kind.__name__}: not built")
        return element

    def at(self, name: str) -> Element[Values] | None:
        """Return what fills a slot; None if nothing was built there."""
        return self._elements[name]

    def draw(self, name: str, frame: Frame, part: Callable[[Frame], object] | None = None) -> None:
        """Draw what fills a slot, or only a ``part`` of it, if it was built and is shown now."""
        element, names = self._elements[name], self._slots[name].names
        if element is not None and not self.shown.isdisjoint(names):
            with drawing(*names):
                (part or element.draw)(frame)

    def release(self) -> None:
        """Release the elements, last built first; may be called twice.

        None is kept: what they were built from takes memory, and each knows the others.
        """
        built = list(self._elements.values())
        self._elements = dict.fromkeys(self._elements)
        self._by_kind.clear()
        _release(reversed(built))


class OfElements(Generic[Values]):
    """A scene that elements draw."""

    elements: Elements[Values]

    @property
    def shown(self) -> set[str]:
        """The names of the elements to draw; may be changed between frames."""
        return self.elements.shown

    @shown.setter
    def shown(self, names: set[str]) -> None:
        self.elements.shown = names


def _release(elements: Iterable[Element[Values] | None]) -> None:
    for element in elements:
        if element is not None:
            element.release()
