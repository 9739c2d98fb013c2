"""One test for many small cases: it tries all of them, and lists those that fail.

A parametrized test is collected, run and reported case by case, which takes longer than a case
that only looks at a table.
"""

import functools
import inspect
from collections.abc import Callable, Iterable
from typing import Any

import pytest


def each(
    name: str, values: Iterable[Any], ids: Callable[[Any], str] = repr
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Run a test for each value of its argument ``name``; its fixtures are shared by all.

    ``pytest -k VALUE`` finds the test by each value that is a text, as if it were parametrized.
    """
    cases = list(values)

    def folded(test: Callable[..., None]) -> Callable[..., None]:
        @functools.wraps(test)
        def run_all(**fixtures: Any) -> None:
            assert cases, "no case"
            failed = []
            for value in cases:
                try:
                    test(**{name: value}, **fixtures)
                except (Exception, pytest.fail.Exception) as error:
                    failed.append(f"{ids(value)}: {type(error).__name__}: {error}")
            assert not failed, f"{len(failed)} of {len(cases)} failed:\n" + "\n".join(failed)

        signature = inspect.signature(test)
        others = [each for each in signature.parameters.values() if each.name != name]
        run_all.__signature__ = signature.replace(parameters=others)  # type: ignore[attr-defined]
        # pytest takes the attributes of a test for keywords.
        run_all.__dict__.update({value: True for value in cases if isinstance(value, str)})
        return run_all

    return folded
