"""Pairs of programs that share what is rare in their class: to be looked at, never a verdict.

In an exercise most of every program is the start, and right programs resemble each other. So what
the start has, in any language, or a solution, or a mistake that the exercise knows, is no evidence;
nor is what many in the class have. The rest is evidence where two programs share it:

- comments, names, numbers and texts that nobody else has;
- the same sequence of tokens, whatever the names and numbers in it are: k-grams, of which winnowing
  keeps the least hash of each window (Schleimer, Wilkerson and Aiken, Winnowing: Local Algorithms
  for Document Fingerprinting, SIGMOD 2003).

Renamed variables leave the sequences and the numbers, functions in another order leave all but some
sequences, changed comments leave all but these.
"""

import builtins
import io
import keyword
import math
import re
import tokenize
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from hashlib import blake2b
from itertools import combinations

from framelens.base.texts import LANGUAGES
from landscape.course.grader.grading import _
from landscape.course.grader.mutants import mutants
from landscape.course.shelf import Exercise, start
from landscape.course.solutions import ways, whole

GRAM = 12  # tokens, chosen: about two short lines
WINDOW = 4  # k-grams, chosen: what is as long as GRAM + WINDOW - 1 tokens is found
COMMON = 4, 20  # chosen: what more than so many have, or than a 20th of the class, is not rare
LEAST = 8.0  # chosen: a pair with less is not shown
MANY = 30  # chosen: pairs that are shown
COMMENT = "comment"
NAME = "name"
NUMBER = "number"
TEXT = "text"
SEQUENCE = "sequence"
WORDS = {  # as a reader sees them
    COMMENT: _("comment"),
    NAME: _("name"),
    NUMBER: _("number"),
    TEXT: _("text"),
    SEQUENCE: _("same sequence of tokens"),
}
MOST_WORDS = 4  # of a comment, chosen: more weigh no more
LONG = 4  # letters of a name, or digits of a number, chosen: a shorter one may be chance
SHORT_WEIGHT = 0.5  # chosen
# Names that everybody writes, beside Python's own and those after a dot: OpenGL's.
USUAL = re.compile(r"(gl|glu|glut|glfw)[A-Z]\w*|(GL|GLU|GLUT)_\w+|glfw|np|math|sys|numpy|self")
Key = tuple[str, str]


@dataclass(frozen=True)
class Shared:
    """A piece of evidence: its kind, what it is, and its line in either program."""

    kind: str
    text: str
    lines: tuple[int, int]


@dataclass(frozen=True)
class Pair:
    """Two programs, by their numbers, and what they share; the highest ``score`` comes first."""

    first: int
    second: int
    score: float
    shared: Sequence[Shared]


@lru_cache(maxsize=512)
def _is_usual(name: str) -> bool:
    """Return whether many programs have a name: of Python's, or a short one."""
    return USUAL.fullmatch(name) is not None or hasattr(builtins, name)


def traces(code: str) -> Mapping[Key, int]:
    """Return what may be evidence in a program, with the line where each stands first.

    What Python cannot read has as much as comes before that.
    """
    found: dict[Key, int] = {}
    sequence: list[tuple[str, int]] = []
    before = ""
    for token in _tokens(code):
        line = token.start[0]
        attribute, before = before == ".", token.string
        if token.type == tokenize.COMMENT:
            words = re.findall(r"\w+", token.string.casefold())
            if words:
                found.setdefault((COMMENT, " ".join(words)), line)
            continue
        if token.type == tokenize.NAME and not keyword.iskeyword(token.string):
            usual = attribute or _is_usual(token.string)
            sequence.append((token.string if usual else "N", line))
            if not usual:
                found.setdefault((NAME, token.string), line)
        elif token.type == tokenize.NUMBER:
            sequence.append(("0", line))
            found.setdefault((NUMBER, token.string), line)
        elif token.type == tokenize.STRING:
            sequence.append(("S", line))
            found.setdefault((TEXT, " ".join(token.string.split())), line)
        elif token.string.strip():
            sequence.append((token.string, line))

    for gram, line in _grams(sequence):
        found.setdefault((SEQUENCE, gram), line)
    return found


def _tokens(code: str) -> Iterator[tokenize.TokenInfo]:
    try:
        yield from tokenize.generate_tokens(io.StringIO(code).readline)
    except (tokenize.TokenError, SyntaxError, ValueError):
        return


def _grams(sequence: Sequence[tuple[str, int]]) -> Iterator[tuple[str, int]]:
    """Yield each k-gram of tokens as a hash, with its line."""
    for at in range(len(sequence) - GRAM + 1):
        words = "\x00".join(word for word, _line in sequence[at : at + GRAM])
        yield blake2b(words.encode("utf-8", "replace"), digest_size=8).hexdigest(), sequence[at][1]


def winnowed(found: Mapping[Key, int]) -> dict[Key, int]:
    """Return traces with few of their k-grams: of each window the one with the least hash."""
    grams = [key for key in found if key[0] == SEQUENCE]
    kept = {
        min(grams[at : at + WINDOW], key=lambda key: key[1])
        for at in range(max(len(grams) - WINDOW + 1, min(len(grams), 1)))
    }
    return {key: line for key, line in found.items() if key[0] != SEQUENCE or key in kept}


def known(exercise: Exercise) -> set[Key]:
    """Return what is no evidence: of the start, the solutions and the mistakes of an exercise."""
    programs = [start(exercise, language) for language in LANGUAGES]
    files = [path for path in ways(exercise.folder) if path.is_file()]
    right = [whole(path, exercise.folder) for path in files]
    programs += right
    if (exercise.folder / "mutants.py").is_file() and right:
        solution = right[0]
        programs += [mutant.of(solution) for mutant in mutants(exercise).values()]
    return {key for program in programs for key in traces(program)}


def _owners(found: Sequence[Mapping[Key, int]]) -> dict[Key, list[int]]:
    """Return for each piece of evidence the numbers of the programs that have it."""
    owners: dict[Key, list[int]] = defaultdict(list)
    for number, each in enumerate(found):
        for key in each:
            owners[key].append(number)
    return owners


def _shared(
    owners: Mapping[Key, Sequence[int]], whose: Sequence[str]
) -> dict[tuple[int, int], list[Key]]:
    """Return for each pair of programs the evidence that they share, if few students have it."""
    most = max(COMMON[0], len(whose) // COMMON[1])
    shared: dict[tuple[int, int], list[Key]] = defaultdict(list)
    for key, numbers in owners.items():
        if len({whose[number] for number in numbers}) <= most:
            for pair in combinations(numbers, 2):
                shared[pair].append(key)
    return shared


def pairs(programs: Sequence[str], common: set[Key], whose: Sequence[str]) -> list[Pair]:
    """Return the pairs of programs of an exercise that share rare evidence, the most first.

    ``common`` is no evidence (:func:`known`). ``whose`` says whose each program is: two of the same
    student are no pair.
    """
    found = [
        winnowed({key: line for key, line in traces(code).items() if key not in common})
        for code in programs
    ]
    owners = _owners(found)
    shared = _shared(owners, whose)
    result = []
    for (first, second), keys in shared.items():
        score = sum(_weight(key) * _rarity(len(owners[key]), len(programs)) for key in keys)
        if whose[first] != whose[second] and score >= LEAST:
            lines = ((key, (found[first][key], found[second][key])) for key in keys)
            result.append(Pair(first, second, round(score, 1), _listed(lines)))
    return sorted(result, key=lambda pair: (-pair.score, pair.first, pair.second))[:MANY]


def _weight(key: Key) -> float:
    """Return how much a piece of evidence counts."""
    kind, text = key
    if kind == COMMENT:
        return float(min(text.count(" ") + 1, MOST_WORDS))
    if kind == SEQUENCE:
        return 1.0
    letters = len(re.sub(r"\W", "", text))
    return 1.0 if letters >= LONG else SHORT_WEIGHT


def _rarity(owners: int, programs: int) -> float:
    """Return 1 for what two of many programs have, less for what more have."""
    if programs <= 2:
        return 1.0
    return max(math.log(programs / owners) / math.log(programs / 2), 0.0)


def _listed(keys: Iterable[tuple[Key, tuple[int, int]]]) -> list[Shared]:
    """Return evidence in the order of the first program's lines; of sequences one for a line."""
    found: dict[Key, Shared] = {}
    for (kind, text), lines in sorted(keys, key=lambda each: (each[1], each[0])):
        shown = "" if kind == SEQUENCE else text
        found.setdefault((kind, shown or str(lines[0])), Shared(kind, shown, lines))
    return list(found.values())
