"""Settings of the whole suite: hypothesis draws the same examples everywhere and never judges by the clock.

Programs that tests start can be interrupted, whatever the suite itself was started by: a shell has its background jobs
ignore Ctrl-C, and with them all that they start. Matplotlib keeps its list of fonts in a folder of the suite's own,
whatever lies in the user's.
"""

from __future__ import annotations

import os
import shutil
import signal
import tempfile

import pytest
from hypothesis import settings

signal.signal(signal.SIGINT, signal.default_int_handler)

settings.register_profile("kinsym", deadline=None, derandomize=True)
settings.load_profile("kinsym")

_FONTS = pytest.StashKey[str]()


def pytest_configure(config: pytest.Config) -> None:
    """One folder for all workers, which the process that starts them makes and :func:`pytest_unconfigure` removes."""
    if not hasattr(config, "workerinput"):
        config.stash[_FONTS] = os.environ["MPLCONFIGDIR"] = tempfile.mkdtemp(prefix="kinsym-fonts-")


def pytest_unconfigure(config: pytest.Config) -> None:
    """No worker is left that needs its list of fonts."""
    if _FONTS in config.stash:
        shutil.rmtree(config.stash[_FONTS], ignore_errors=True)


@pytest.fixture
def few_poses(monkeypatch: pytest.MonkeyPatch) -> None:
    """Checks at a tenth of the poses, for tests of what becomes of a check; what it finds other tests ask."""
    from kinsym.check import compare
    from kinsym.check.poses import Counts

    few = Counts(uniform=40, quarter=24, singular=24, pair=8, exact=12)
    for name in ("FULL", "DIVIDED"):
        monkeypatch.setattr(compare, name, few)
    monkeypatch.setattr(compare, "CHOICES", 2)
