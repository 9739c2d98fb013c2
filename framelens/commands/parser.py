"""The parser of a command line, its commands, and the options that many commands share."""

import argparse
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from types import ModuleType
from typing import Any, NoReturn, Protocol

from framelens.base import arguments
from framelens.base.errors import InputError
from framelens.base.texts import LANGUAGES, Phrases, Translator, marked, translator
from framelens.commands import option_values

ARGPARSE: Phrases = (
    "argument %(argument_name)s: %(message)s",
    "expected one argument",
    "expected at most one argument",
    "expected at least one argument",
    "invalid choice: %(value)r (choose from %(choices)s)",
    "the following arguments are required: %s",
    "not allowed with argument %s",
    "one of the arguments %s is required",
    "ambiguous option: %(option)s could match %(matches)s",
    "ignored explicit argument %r",
    "invalid %(type)s value: %(value)r",
)
"""What argparse says of a command line that it cannot read."""


class Command(Protocol):
    """The interface of a command's module."""

    EXAMPLE: str
    """The words that follow the command's name in the example of its help."""

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Add the command's arguments and options."""

    def run(self, options: argparse.Namespace) -> int:
        """Do what the options say; return the exit status."""


Options = argparse._ActionsContainer
"""A parser, or a group of its options."""


class Parser(argparse.ArgumentParser):
    """A parser whose errors are an InputError of one line."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        # Text that begins like this is a value, never an option: a pose may be -1,2,3,0,0.
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message: str) -> NoReturn:
        """Report the error in one line, as for all bad input."""
        raise InputError("{message} (see `{program} --help`)", message=message, program=self.prog)


@contextmanager
def argparse_speaking(language: str) -> Iterator[None]:
    """Let the errors of argparse be in a language: it has a function for its texts, gettext's."""
    before = argparse._  # type: ignore[attr-defined]
    argparse._ = translator(language, "errors")  # type: ignore[attr-defined]
    try:
        yield
    finally:
        argparse._ = before  # type: ignore[attr-defined]


def language_asked(words: Sequence[str]) -> str:
    """Return the language that a command line, in words, asks for by --lang; "" if none.

    It is read here before the command line is parsed, as the parser's errors are in it.
    """
    asked = [after for word, after in zip(words, words[1:], strict=False) if word == "--lang"]
    asked += [word.removeprefix("--lang=") for word in words if word.startswith("--lang=")]
    return asked[-1] if asked and asked[-1] in LANGUAGES else ""


class HelpFormatter(argparse.HelpFormatter):
    """Writes a help with each of its texts translated."""

    def __init__(self, translate: Translator, **options: Any) -> None:
        super().__init__(**options)
        self._translate = translate

    def add_usage(
        self,
        usage: str | None,
        actions: Iterable[argparse.Action],
        groups: Iterable["argparse._MutuallyExclusiveGroup"],
        prefix: str | None = None,
    ) -> None:
        prefix = self._translate("usage: ") if prefix is None else prefix
        super().add_usage(usage, actions, groups, prefix)

    def start_section(self, heading: str | None) -> None:
        super().start_section(heading and self._translate(heading))

    def add_text(self, text: str | None) -> None:
        super().add_text(text and self._translate(text))

    def _get_help_string(self, action: argparse.Action) -> str | None:
        return action.help and self._translate(action.help)


def add_commands(
    parser: argparse.ArgumentParser,
    commands: Mapping[str, str],
    package: str,
    asked: Sequence[str] | None = None,
    translate: Translator = marked,
) -> None:
    """Add commands, by name with what they do, to the parser of a program.

    A command's module, a :class:`Command`, lies in a package under the command's name. A name of
    two words is an action of the command of its first word, whose module has only an EXAMPLE.
    ``asked`` are the first words of a command line: where they begin with a command, only its
    module is imported; else the commands are listed, and none is.
    """
    parser.set_defaults(run=print_help(parser))
    below = {"": parser.add_subparsers(metavar="COMMAND", parser_class=Parser)}
    if asked is None:
        chosen = list(commands)
    else:
        chosen = [name for name in commands if name.split()[:1] == list(asked[:1])]

    for name in chosen or commands:
        group, _space, word = name.rpartition(" ")
        if not chosen:
            if not group:
                below[""].add_parser(word, help=commands[name])
            continue
        module = import_module(f"{package}.{name.replace(' ', '_').replace('-', '_')}")
        example = f"{parser.prog} {name} {module.EXAMPLE}".rstrip()
        sub = below[group].add_parser(
            word,
            help=commands[name],
            description=getattr(module, "DESCRIPTION", commands[name]),
            epilog=f"{translate('example: ')}{example}",
            formatter_class=partial(HelpFormatter, translate),
        )
        below |= _actions(name, sub, module)


def _actions(
    name: str, sub: Parser, module: ModuleType
) -> "dict[str, argparse._SubParsersAction[Parser]]":
    """Let a command's parser run its module; return where its actions go, if it only has these."""
    if hasattr(module, "run"):
        module.add_arguments(sub)
        sub.set_defaults(run=module.run)
        return {}
    sub.set_defaults(run=print_help(sub))
    return {name: sub.add_subparsers(metavar="ACTION", parser_class=Parser)}


def parted(words: list[str], programs: Collection[str]) -> tuple[list[str], list[str]]:
    """Part a command line, in words, from what its program gets: what follows `--`.

    ``programs`` are the commands that run a program.
    """
    if not words or words[0] not in programs or "--" not in words:
        return words, []
    at = words.index("--")
    return words[:at], words[at + 1 :]


def print_help(parser: argparse.ArgumentParser) -> Callable[[argparse.Namespace], int]:
    """Return what a command does that is given without its own command: print the help."""

    def show(_: argparse.Namespace) -> int:
        parser.print_help()
        return 0

    return show


def language_option(
    parser: argparse.ArgumentParser, what: str = "language of the captions"
) -> None:
    parser.add_argument(
        "--lang",
        choices=LANGUAGES,
        default="",
        help=f"{what}; default: by LANGUAGE, LC_ALL, LC_MESSAGES or LANG",
    )


def backend_option(parser: Options) -> None:
    """Add --backend."""
    parser.add_argument(
        "--backend",
        type=option_values.backend,
        default="auto",
        metavar="|".join(arguments.BACKENDS),
        help="how OpenGL is opened; default: %(default)s, the first that works",
    )
