"""The help of the course's commands in the user's language."""

import argparse
import os
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

from framelens.base.texts import LANGUAGES, Phrases, Translator, choose, translator

COMMANDS = ("lesson", "exercise", "lecture")
SHARED: Phrases = (  # what argparse says, and what other commands say, too
    "usage: ",
    "positional arguments",
    "options",
    "example: ",
    "show this help message and exit",
    "language of the texts; default: by LANGUAGE, LC_ALL, LC_MESSAGES or LANG",
    "how OpenGL is opened; default: %(default)s, the first that works",
)


def language(words: Sequence[str]) -> str:
    """Return the language in which a command line, in words, is answered; "en" but in the course.

    It is read here before the command line is parsed, as the parser's errors are in it.
    """
    if not words or words[0] not in COMMANDS:
        return "en"
    asked = [after for word, after in zip(words, words[1:], strict=False) if word == "--lang"]
    asked += [word.removeprefix("--lang=") for word in words if word.startswith("--lang=")]
    return asked[-1] if asked and asked[-1] in LANGUAGES else choose(os.environ)


class _Formatter(argparse.HelpFormatter):
    """Writes the first word of a usage in a language."""

    def __init__(self, translate: Translator, **options: Any) -> None:
        super().__init__(**options)
        self._translate = translate

    def add_usage(self, usage: Any, actions: Any, groups: Any, prefix: str | None = None) -> None:
        super().add_usage(usage, actions, groups, prefix or self._translate("usage: "))


def put(commands: Any, language: str) -> None:
    """Put the help of the course's commands, among the parsers of all, into a language."""
    _ = translator(language, "course")
    for parser in _parsers([commands.choices[name] for name in COMMANDS]):
        parser.formatter_class = partial(_Formatter, _)
        parser.description = parser.description and _(parser.description)
        word, example = (parser.epilog or "").split("landscape", 1)
        parser.epilog = f"{_(word)}landscape{example}"
        for group in parser._action_groups:
            group.title = group.title and _(group.title)
        for action in parser._actions:
            # A command that has actions lists them.
            for each in (action, *getattr(action, "_choices_actions", ())):
                each.help = each.help and _(each.help)


def _parsers(begin: Sequence[argparse.ArgumentParser]) -> Iterator[argparse.ArgumentParser]:
    """Yield parsers, and those of their actions."""
    for parser in begin:
        yield parser
        for action in parser._actions:
            if isinstance(action, argparse._SubParsersAction):
                yield from _parsers(list(action.choices.values()))
