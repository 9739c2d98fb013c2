"""Progress: shown on a terminal only, and never in the way of the output."""

import io
import os
import sys

import pytest

from framelens.base.progress import Progress


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def progress_of(
    total: int, monkeypatch: pytest.MonkeyPatch, err: object, quiet: bool = False
) -> None:
    monkeypatch.setattr(sys, "stderr", err)
    with Progress(total, quiet) as progress:
        for k in range(total):
            progress.step(f"view{k}")


def test_progress_counts_every_step_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    err = Terminal()
    progress_of(3, monkeypatch, err)
    for k in range(3):
        assert f"{k + 1}/3 view{k}" in err.getvalue()
    assert err.getvalue().endswith("\n")


def test_bytes_are_shown_in_their_unit_and_never_go_backwards(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    err = Terminal()
    monkeypatch.setattr(sys, "stderr", err)
    with Progress(2_000_000, title="bunny", unit="B") as progress:
        for done in (1_000_000, 2_000_000, 0):
            progress.reach(done)
    assert "2.00M/2.00M bunny" in err.getvalue().split("\r")[-1]


def test_a_total_that_is_not_known_is_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    err = Terminal()
    monkeypatch.setattr(sys, "stderr", err)
    with Progress(None, title="bunny", unit="B") as progress:
        progress.reach(5000)
    assert "5.00k/? bunny" in err.getvalue()


@pytest.mark.parametrize(("total", "quiet"), [(3, True), (1, False)])
def test_no_progress_when_quiet_or_for_a_single_step(
    total: int, quiet: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    err = Terminal()
    progress_of(total, monkeypatch, err, quiet)
    assert err.getvalue() == ""


def test_no_progress_where_standard_error_is_a_file_or_closed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    err = io.StringIO()
    progress_of(3, monkeypatch, err)
    assert err.getvalue() == ""
    progress_of(3, monkeypatch, None)
    with open(os.devnull, "w") as closed:
        pass
    progress_of(3, monkeypatch, closed)


def test_standard_error_closed_meanwhile_does_not_end_the_job(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    err = Terminal()
    monkeypatch.setattr(sys, "stderr", err)
    with Progress(3) as progress:
        progress.step("one")
        err.close()
        progress.step("two")
        progress.step("three")
