"""The deadline: it ends a derivation in time, in any thread, and says what was reached; the command line takes it."""

from __future__ import annotations

import math
import threading
import time

import pytest

from kinsym.cli import main
from kinsym.deadline import Deadline
from kinsym.deriving import derive
from kinsym.errors import DeadlineExceeded, KinsymError, NoClosedForm
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
OVERSHOOT = 1.0


@pytest.mark.parametrize("name", TABLES)
@pytest.mark.parametrize("seconds", [0.001, 0.15, 0.4])
def test_the_derivation_ends_soon_after_its_deadline(name: str, seconds: float) -> None:
    """Processor time: other work on the machine is not the derivation's."""
    robot = from_inline(TABLES[name], convention="paul", name="arm")
    start = time.process_time()
    try:
        derive(robot, deadline=seconds)
    except (DeadlineExceeded, NoClosedForm):
        pass
    else:
        pytest.fail("these tables take longer")
    assert time.process_time() - start < seconds + OVERSHOOT


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
