"""Drafts of robots for the tests of this folder."""

from __future__ import annotations

import copy
from typing import Any

from kinsym.robot import Robot
from kinsym.robot.files import from_draft

Draft = dict[str, Any]

ARM: Draft = {
    "name": "arm",
    "convention": "paul",
    "joints": [
        {"type": "R", "alpha": "pi/2", "a": "0", "d": "d1", "theta": "theta1"},
        {"type": "R", "alpha": "0", "a": "a2", "d": "0", "theta": "theta2 - pi/2"},
        {"type": "P", "alpha": "0", "a": "a3", "d": "d3 + 0.1", "theta": "0"},
    ],
}
SCREWS: Draft = {
    "name": "arm",
    "convention": "screw",
    "joints": [
        {"type": "R", "s": ["0", "0", "1"], "s0": ["0", "0", "0"]},
        {"type": "P", "s": ["3/5", "4/5", "0"], "s0": ["a1", "0", "0"]},
    ],
    "home": {"u0": [1, 0, 0], "v0": [0, 1, 0], "w0": [0, 0, 1], "q0": ["a1 + a2", 0, 0]},
}


def changed(base: Draft, *path: str | int, to: object = None, drop: bool = False) -> Draft:
    """A copy of a draft with one entry set or dropped."""
    draft = copy.deepcopy(base)
    place: Any = draft
    for step in path[:-1]:
        place = place.setdefault(step, {}) if isinstance(place, dict) else place[step]
    if drop:
        del place[path[-1]]
    else:
        place[path[-1]] = to
    return draft


def build(draft: Draft) -> Robot:
    """The robot of a draft, named as a file would be in messages."""
    return from_draft(draft, where="arm.toml")
