"""The test of parameters: nothing may vanish that the equations take for granted."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from kinsym.algebra.tree import ZERO, Num, Sym, mul
from kinsym.emit.printer import Printer
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.needs import nonzero_needs
from kinsym.emit.text.formula import TextPrinter


@dataclass(frozen=True, kw_only=True)
class Vanishing:
    """A value that must exceed ``least``: how the derivation writes it, and how to ask for an arm where it is zero."""

    value: str
    least: str
    name: str
    remedy: str


def vanishing(schedule: Schedule, printer: Printer) -> Iterator[Vanishing]:
    """The tests; ``size`` is the sum of the arm's constant lengths."""
    tau = Num(schedule.tau)
    for item in schedule.nonzero:
        least = {None: ZERO, 0: tau, 1: mul(tau, Sym("size"))}[item.unit]
        bound = "0" if item.unit == 1 else "..."
        yield Vanishing(
            value=printer(item.value),
            least=printer(least),
            name=TextPrinter()(item.value),
            remedy=" ".join(f"--bind {name}={bound}" for name in item.parameters),
        )


def regular_names(schedule: Schedule, printer: Printer) -> dict[str, Any]:
    """What the templates of both languages read."""
    return {
        "regular": nonzero_needs(schedule),
        "lengths": printer(schedule.lengths) if any(item.unit == 1 for item in schedule.nonzero) else "",
        "vanishing": list(vanishing(schedule, printer)),
    }
