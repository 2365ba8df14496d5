"""Arms for the tests of single precision, derived once."""

from __future__ import annotations

from functools import cache

from kinsym.emit.program import build_schedule
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.single import in_single
from tests import arms

ARMS = ("planar_rr", "scara", "ur5")
"""Small ones: one plane, a slide, six joints."""


@cache
def single_schedule(name: str) -> Schedule:
    """What the C of an arm is made from."""
    return in_single(build_schedule(arms.derivation(name)))
