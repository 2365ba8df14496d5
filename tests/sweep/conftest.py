"""Sweeps of many small tasks that write at once."""

from __future__ import annotations

import pytest


@pytest.fixture
def small_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Many tasks instead of one."""
    monkeypatch.setattr("kinsym.workspace.sweeping._POSES", 1000)


@pytest.fixture
def eager(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is found is written at once."""
    monkeypatch.setattr("kinsym.workspace.partial._PAUSE", 0.0)
    monkeypatch.setattr("kinsym.workspace.partial._COST", 0.0)
