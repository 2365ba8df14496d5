"""The deadline: it ends a derivation in time, in any thread, and says what was reached; the command line takes it."""

from __future__ import annotations

import math
import sys
import threading

import pytest

from kinsym.cli import main
from kinsym.deadline import Deadline
from kinsym.deriving import derive
from kinsym.errors import DeadlineExceeded, KinsymError
from kinsym.robot import from_inline, load

LONG = (
    "alpha1 a1 d1 theta1; alpha2 a2 d2 theta2; alpha3 a3 d3 theta3; "
    "alpha4 a4 d4 theta4; alpha5 a5 d5 theta5; alpha6 a6 d6 theta6"
)
TABLES = {
    "general": LONG,
    "pieper": LONG.replace("a4 d4", "0 d4").replace("a5 d5", "0 0"),
    "sliding": LONG.replace("d2 theta2", "d2 0").replace("a4 d4", "0 d4").replace("a5 d5", "0 0"),
}
#: Calls of functions between two looks at the clock: a second or less on any machine of today.
MOST_CALLS = 4_000_000


class Clock:
    """Time that goes by one with every look at it, and how many functions were called between two looks."""

    def __init__(self) -> None:
        self.looks = self.calls = self.most = 0

    def monotonic(self) -> float:
        self.looks, self.most, self.calls = self.looks + 1, max(self.most, self.calls), 0
        return float(self.looks)

    def profile(self, frame: object, event: str, argument: object) -> None:
        self.calls += event in ("call", "c_call")


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    """A clock that every deadline looks at."""
    clock = Clock()
    monkeypatch.setattr("kinsym.deadline.time", clock)
    return clock


@pytest.mark.parametrize("name", TABLES)
def test_the_clock_is_looked_at_often(name: str, clock: Clock) -> None:
    sys.setprofile(clock.profile)
    try:
        derive(from_inline(TABLES[name], convention="paul", name="arm"), deadline=1e9)
    finally:
        sys.setprofile(None)
    assert clock.looks > 500
    assert max(clock.most, clock.calls) < MOST_CALLS


@pytest.mark.parametrize("name", TABLES)
@pytest.mark.parametrize("looks", [1, 10, 100, 400])
def test_the_derivation_ends_at_its_deadline(name: str, looks: int, clock: Clock) -> None:
    with pytest.raises(DeadlineExceeded, match=f"did not end within {looks} s"):
        derive(from_inline(TABLES[name], convention="paul", name="arm"), deadline=looks)
    # one look to begin with, one where a verdict begins a time of its own, one past the end
    assert looks + 2 <= clock.looks <= looks + 3


def test_the_message_says_what_was_reached() -> None:
    with pytest.raises(DeadlineExceeded, match=r"did not end within 0.001 s. Reached: .*--deadline") as caught:
        derive(load("ur5"), deadline=0.001)
    assert caught.value.exit_status == 2


def test_time_enough_changes_nothing() -> None:
    assert derive(load("scara"), deadline=60.0).plan == derive(load("scara")).plan


@pytest.mark.parametrize("seconds", [0.0, -1.0, math.nan, math.inf])
def test_what_is_no_time_is_refused(seconds: float) -> None:
    with pytest.raises(KinsymError, match="positive number of seconds"):
        derive(load("scara"), deadline=seconds)


def test_a_deadline_notes_how_far_the_work_has_come() -> None:
    deadline = Deadline(1e-9)
    with pytest.raises(DeadlineExceeded, match="Reached: theta1 found"):
        deadline.note("theta1 found")
    Deadline(None).note("anything")


def test_every_thread_has_its_own() -> None:
    """No signal is used, which Python gives to the main thread alone."""
    outcomes: dict[str, str] = {}

    def work(name: str, seconds: float | None) -> None:
        try:
            derive(load("puma560"), deadline=seconds)
            outcomes[name] = "solved"
        except DeadlineExceeded:
            outcomes[name] = "late"

    threads = [threading.Thread(target=work, args=item) for item in (("short", 0.01), ("long", None))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert outcomes == {"short": "late", "long": "solved"}


@pytest.mark.parametrize("command", ["show", "derive"])
def test_the_command_line_takes_it(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([command, "ur5", "--deadline", "0.001"]) == 2
    assert "did not end within 0.001 s" in capsys.readouterr().err
    assert main([command, "ur5", "--deadline", "nan"]) == 2
    assert "positive number" in capsys.readouterr().err
    assert main([command, "ur5", "--deadline", "soon"]) == 2
