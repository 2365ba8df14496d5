"""The table of attacks and places: nothing runs, nothing takes long or much memory, every refusal can be acted upon."""

from __future__ import annotations

import os
import resource
import time
from pathlib import Path

import pytest

from kinsym.errors import KinsymError, RobotError
from kinsym.robot import Robot
from tests.hostile.attacks import ATTACKS, PLACES, Place

SECONDS = 3.0
KIBIBYTES = 64 << 10
LONGEST_MESSAGE = 1200


@pytest.mark.parametrize("place", PLACES.values(), ids=PLACES)
def test_every_attack_is_harmless(
    place: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A robot, or one printable line that says where and how to mend it; in bounded time and memory."""
    monkeypatch.chdir(tmp_path)
    for name, text in ATTACKS.items():
        before = set(os.listdir(tmp_path))
        start = time.process_time()
        most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        try:
            robot = place(tmp_path, text)
            assert robot is None or isinstance(robot, Robot), name
        except KinsymError as error:
            check_message(error, name)
        for line in capsys.readouterr().err.splitlines():
            assert line.isprintable(), name
            assert "Traceback" not in line, name
        assert time.process_time() - start < SECONDS, name
        assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - most < KIBIBYTES, name
        assert set(os.listdir(tmp_path)) - before <= {"arm.toml", "arm.csv", "arm.urdf"}, name


def check_message(error: KinsymError, attack: str) -> None:
    """One line of bounded length with a place and a remedy."""
    text = str(error)
    assert text.isprintable(), (attack, text)
    assert len(text) < LONGEST_MESSAGE, (attack, text)
    assert text.endswith("."), (attack, text)
    if isinstance(error, RobotError):
        assert error.remedy, (attack, text)
        assert error.where or "gallery" in text, (attack, text)
