"""Settings of the whole suite: hypothesis draws the same examples everywhere and never judges by the clock.

Programs that tests start can be interrupted, whatever the suite itself was started by: a shell has its background jobs
ignore Ctrl-C, and with them all that they start.
"""

from __future__ import annotations

import signal

import pytest
from hypothesis import settings

signal.signal(signal.SIGINT, signal.default_int_handler)

settings.register_profile("kinsym", deadline=None, derandomize=True)
settings.load_profile("kinsym")


@pytest.fixture
def few_poses(monkeypatch: pytest.MonkeyPatch) -> None:
    """Checks at a tenth of the poses, for tests of what becomes of a check; what it finds other tests ask."""
    from kinsym.check import compare
    from kinsym.check.poses import Counts

    few = Counts(uniform=40, quarter=24, singular=24, pair=8, exact=12)
    for name in ("FULL", "DIVIDED"):
        monkeypatch.setattr(compare, name, few)
    monkeypatch.setattr(compare, "CHOICES", 2)
