"""An executor that is not ours, for the functions that take any ``concurrent.futures.Executor``."""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import Any


class Backwards(Executor):
    """Does its tasks in this process when the first result is asked for, the last task first."""

    def __init__(self) -> None:
        self.order: list[int] = []  # the tasks by number, as they were done
        self._count = 0
        self._waiting: list[tuple[int, Future, Callable[..., Any], tuple[Any, ...]]] = []

    def submit(self, function: Callable[..., Any], /, *arguments: Any, **named: Any) -> Future:
        assert not named
        future = _Asked(self)
        self._waiting.append((self._count, future, function, arguments))
        self._count += 1
        return future

    def work(self) -> None:
        while self._waiting:
            number, future, function, arguments = self._waiting.pop()
            if not future.set_running_or_notify_cancel():
                continue
            self.order.append(number)
            try:
                future.set_result(function(*arguments))
            except Exception as error:
                future.set_exception(error)


class _Asked(Future):
    def __init__(self, executor: Backwards) -> None:
        super().__init__()
        self._executor = executor

    def result(self, timeout: float | None = None) -> Any:
        if not self.done():
            self._executor.work()
        return super().result(timeout)
