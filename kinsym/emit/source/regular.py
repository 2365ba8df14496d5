"""The test of parameters: nothing may vanish that the equations take for granted."""

from __future__ import annotations

from fractions import Fraction

from kinsym.algebra.tree import ONE, ZERO, Num, Sym, Tree, mul
from kinsym.emit.schedule import Schedule
from kinsym.emit.text.formula import TextPrinter
from kinsym.inverse.plan import Nonzero


def is_length(item: Nonzero) -> bool:
    """Whether it is compared with the arm's lengths."""
    return item.scale not in (ONE, ZERO)


def least_value(item: Nonzero, tau: Fraction) -> Tree:
    """What the absolute value has to exceed; ``size`` is the sum of the arm's constant lengths."""
    return mul(Num(tau), Sym("size")) if is_length(item) else mul(Num(tau), item.scale)


def conditions(schedule: Schedule) -> list[str]:
    """What must not vanish, as the derivation writes it."""
    return [TextPrinter()(item.value) for item in schedule.nonzero]


def remedies(schedule: Schedule) -> list[str]:
    """For each of them the parameters to fold into the table, as the command line takes them."""
    return [
        " ".join(f"--bind {name}={0 if is_length(item) else '...'}" for name in item.parameters)
        for item in schedule.nonzero
    ]
