"""Settings of the whole suite: hypothesis draws the same examples everywhere and never judges by the clock."""

from __future__ import annotations

from hypothesis import settings

settings.register_profile("kinsym", deadline=None, derandomize=True)
settings.load_profile("kinsym")
