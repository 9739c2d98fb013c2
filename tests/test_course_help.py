"""Help and errors of `landscape lesson`, `exercise` and `lecture` in the user's language."""

import pickle
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from commands import Done, Shell, environment, landscape, refused

from framelens.base.errors import InputError, Message
from framelens.base.texts import said

COMMANDS = (
    *("lesson", "exercise", "exercise list", "exercise start", "exercise solution"),
    *("exercise new", "exercise test", "exercise pack", "exercise check", "lecture"),
)


@pytest.fixture(scope="module")
def shell() -> Iterator[Shell]:
    process = Shell(environment(LANGUAGE="en"))
    yield process
    process.close()


@pytest.mark.seldom(5, first=2)
@pytest.mark.parametrize("command", COMMANDS)
def test_a_help_is_french_where_the_user_asks_for_it(command: str, shell: Shell) -> None:
    words = command.split()
    english, french = (shell(*words, "--help"), shell(*words, "--lang", "fr", "--help"))
    if command == "exercise":  # has no --lang of its own
        french = landscape("exercise", "--help", env=environment(LANGUAGE="fr"))
    assert english.out.startswith(f"usage: landscape {command} [-h]")
    assert french.out.startswith(f"utilisation\u00a0: landscape {command} [-h]")
    assert explained(english) and not explained(english) & explained(french)
    assert f"\nexemple\u00a0: landscape {command}" in french.out


def explained(done: Done) -> set[str]:
    """Return what a help says of options and arguments, without their names."""
    text = re.sub(r"\n {10,}", " ", done.out)
    found = {re.split(r" {2,}", line.strip())[-1] for line in text.splitlines()}
    return {line for line in found if len(line.split()) > 1 and "landscape" not in line}


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("exercise", "start"), "il manque les arguments suivants: NAME"),
        (("lesson", "a", "b"), "arguments inconnus: b (voir `landscape --help`)"),
        (("lesson", "fog", "--out"), "argument --out: une valeur est attendue"),
        (("lesson", "fog", "--out", "a.png", "--copy"), "incompatible avec l\u2019argument --out"),
        (("exercise", "check", "a.py", "--seconds", "0"), "'0': donnez un nombre entre 0,1 et 600"),
        (("lesson", "fog", "--backend", "x"), "donnez une valeur parmi auto, osmesa, egl, glfw"),
        (("lecture", "--from", "nowhere"), "donnez le nom d\u2019une étape, ou un numéro de 1 à "),
        (("lecture", "no_such.txt"), "no_such.txt: ne peut pas être lu"),
    ],
)
@pytest.mark.sweep(4)
def test_errors_are_in_the_language_asked_for(
    words: tuple[str, ...], said: str, shell: Shell
) -> None:
    refused(shell(*words, "--lang=fr"), said)
    done = shell(*words, "--lang=en")
    refused(done)
    assert said not in done.err


def test_other_commands_have_english_help_and_refuse_in_the_users_language() -> None:
    french = environment(LANGUAGE="fr")
    help_ = landscape("views", "--help", env=french)
    assert help_.out.startswith("usage: landscape views") and "options:" in help_.out
    refused(landscape("walk", "--no-such", env=french), "arguments inconnus: --no-such")
    refused(landscape("render", "nowhere", env=french), "cette vue n\u2019existe pas")
    refused(landscape("sound", env=french), "il manque les arguments suivants: ", "--out")


@pytest.mark.seldom(10, first=3)
def test_what_the_user_wrote_is_never_translated(tmp_path: Path) -> None:
    words = "expected one, cannot be read {name}"
    for command in (("render", words), ("lecture", tmp_path / words), ("walk", f"--{words}")):
        english = landscape(*command, env=environment(LANGUAGE="en"))
        french = landscape(*command, env=environment(LANGUAGE="fr"))
        refused(english, words)
        refused(french, words)
        assert english.err != french.err


def test_a_message_in_a_message_is_in_the_same_language() -> None:
    error = InputError(
        "setting {key}: expected {expected}, not {value}",
        key="fog.density",
        expected=Message("a number from {low} to {high}", low=0, high=10),
        value="'{low}'",
    )
    assert str(error) == "setting fog.density: expected a number from 0 to 10, not '{low}'"
    assert said(error, "fr") == "setting fog.density: il faut un nombre de 0 à 10, non '{low}'"
    sent = pickle.loads(pickle.dumps(error))
    assert (str(sent), said(sent, "fr")) == (str(error), said(error, "fr"))
