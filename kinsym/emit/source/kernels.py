"""The numerical kernels as the printers see them: what goes in, what comes out.

A step's ``rule`` is the name of its kernel. A kernel is a small helper of the generated source, one template in each
language; it is there only if the plan calls it. Arguments come in one order in every language: the inputs, the
reference value if the unknown can be free, then the outputs.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from kinsym.emit.schedule import Solve, Statement


@dataclass(frozen=True, kw_only=True)
class Kernel:
    """The signature of one kernel.

    ``outputs`` pairs each output's name with whether it differs between the roots. ``plain`` kernels only
    assign their inputs to their outputs and need no helper; the others also tell a mark of each root: free, on a
    border, next to one of these (soft), or in doubt. ``ends`` tells that a branch can end here for lack of a real
    root; such a kernel is told whether a step before it was special (``loose``), for then a root in doubt may become
    real when that moves.
    """

    inputs: tuple[str, ...]
    outputs: tuple[tuple[str, bool], ...]
    free: bool
    branches: int
    plain: bool = False
    ends: bool = False


ANGLE = (("c", True), ("s", True))

_FOUR_LINES = ("xc", "xs", "x", "yc", "ys", "y", "kc", "ks", "k", "lc", "ls", "l", "t")

KERNELS = {
    "direct": Kernel(inputs=("c", "s"), outputs=ANGLE, free=False, branches=1, plain=True),
    "length": Kernel(inputs=("d",), outputs=(("d", True),), free=False, branches=1, plain=True),
    "quotient": Kernel(inputs=("x", "y", "d", "t"), outputs=ANGLE, free=True, branches=1),
    "quotient_length": Kernel(inputs=("n", "d", "t"), outputs=(("d", True),), free=True, branches=1),
    "homogeneous": Kernel(inputs=("a", "b", "t"), outputs=ANGLE, free=True, branches=2),
    "homogeneous2": Kernel(inputs=("a", "b", "t", "a_alt", "b_alt", "t_alt"), outputs=ANGLE, free=True, branches=2),
    "linear": Kernel(inputs=("a", "b", "e", "t"), outputs=ANGLE, free=True, branches=2, ends=True),
    "linear_pole": Kernel(
        inputs=("a", "b", "p", "k", "x", "y", "z", "t"), outputs=ANGLE, free=False, branches=2, ends=True
    ),
    "triangle": Kernel(
        inputs=("x", "y", "l1", "l2", "t"),
        outputs=(("k", False), ("w", True), ("along", False)),
        free=False,
        branches=2,
        ends=True,
    ),
    "direction": Kernel(inputs=("x", "y", "along", "across", "t"), outputs=ANGLE, free=True, branches=1),
    "quadratic": Kernel(inputs=("b", "c", "t"), outputs=(("d", True),), free=False, branches=2, ends=True),
    "quartic": Kernel(
        inputs=(*_FOUR_LINES, *(f"{name}2" for name in _FOUR_LINES)),
        outputs=ANGLE,
        free=True,
        branches=4,
        ends=True,
    ),
}


def kernels_used(statements: Iterable[Statement]) -> tuple[str, ...]:
    """The kernels that need a helper in the source, in the order of the registry."""
    rules = {statement.step.rule for statement in statements if isinstance(statement, Solve)}
    return tuple(rule for rule, kernel in KERNELS.items() if rule in rules and not kernel.plain)
