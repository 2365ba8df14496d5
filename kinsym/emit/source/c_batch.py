"""Many poses at once in C: the inverse kinematics without a branch, a block of poses as lanes.

The levels of the schedule become loops over the lanes. A root that is not there is a zero in a mask, and a pose at
which any root is marked is left to the function for one pose: so the kernels here know nothing but their ordinary
roots, and the answers are those of the function for one pose.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, prod

from kinsym.algebra.tree import Call, Sym, symbols
from kinsym.emit.printer import Printer
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.kernels import KERNELS, kernels_used
from kinsym.emit.source.lanes import Constants, Loop, Loops, arrays_of_poses, constants_of
from kinsym.emit.source.needs import InverseNeeds, line_needs
from kinsym.inverse.plan import Definition

#: How many poses are computed side by side: some registers full, and few enough for their arrays to stay in cache.
LANES = 64

#: The kernels that have a form without a branch.
LANE_KERNELS = frozenset(KERNELS) - {"quartic"}


@dataclass(frozen=True, kw_only=True)
class Batch:
    """What the templates of the batch read.

    kernels     the kernels that are called.
    given       of locked joints whose values the caller gives: what is read of them, computed with the pose.
    constants   what the loops read of what depends on parameters alone; given_constants: what ``given`` reads of it.
    size        what the arm's size is made of: constants, and size_loads of what comes with the pose.
    loops       the loops over the lanes, each inside those over the roots of the steps before it.
    rows        the joint values at the last level, for each of its roots.
    real        the variable that says whether these are there.
    path        the number of the first of them among all paths.
    functions   what the loops call.
    stack       how many kilobytes of stack it takes, about.
    """

    kernels: tuple[str, ...]
    given: tuple[Definition, ...]
    given_constants: Constants
    constants: Constants
    size: Constants
    size_loads: tuple[str, ...]
    loops: tuple[Loop, ...]
    rows: tuple[tuple[str, ...], ...]
    real: str
    path: str
    functions: frozenset[str]
    stack: int


def batch_of(schedule: Schedule, needs: InverseNeeds, printer: Printer) -> Batch | None:
    """The loops of a schedule; None if it calls a kernel that has no form without a branch."""
    used = kernels_used(needs.statements)
    if schedule.general or not LANE_KERNELS.issuperset(used):
        return None
    given = _given(schedule, needs)
    loops = Loops(schedule, needs, printer, given)
    loops.fill()
    rows = loops.rows()
    fixed = [item for item in needs.constants if item not in given]
    arrays, parts = arrays_of_poses(given), list(dict.fromkeys(symbols(schedule.size)))
    return Batch(
        kernels=used,
        given=given,
        given_constants=constants_of(schedule, fixed, (name for item in given for name in symbols(item.value))),
        constants=loops.constants(),
        size=constants_of(schedule, fixed, parts),
        size_loads=tuple(f"{name} = {arrays[name]}" for name in parts if name in arrays),
        loops=loops.loops,
        rows=rows,
        real=f"real{schedule.depth}",
        path=_path(schedule.widths),
        functions=frozenset(loops.functions),
        stack=_stack(schedule, len(given), loops),
    )


def waves(schedule: Schedule) -> frozenset[str]:
    """Which of sine and cosine the forward kinematics takes of joint values."""
    values = [item.value for item in line_needs(schedule, schedule.forward).definitions]
    calls = (value.function for value in values if isinstance(value, Call))
    return frozenset(calls) & {"sin", "cos"}


def _given(schedule: Schedule, needs: InverseNeeds) -> tuple[Definition, ...]:
    """The locked joints whose values the caller gives, and what follows from them."""
    names = set(schedule.inputs)
    found = [Definition(name=name, value=Sym(name)) for name in needs.inputs]
    for item in needs.constants:
        if names.intersection(symbols(item.value)):
            names.add(item.name)
            found.append(item)
    return tuple(found)


def _stack(schedule: Schedule, given: int, loops: Loops) -> int:
    """The kilobytes of the block (``lanes.c.jinja``) and of the arrays of the loops, rounded up to tens."""
    block = 27 + given + schedule.maximum * (len(schedule.joints) + 1)
    arrays = sum(2 if "[2]" in array else 1 for loop in loops.loops for array in loop.arrays)
    return 10 * ceil((block + arrays) * LANES * schedule.real.size / 10240)


def _path(widths: tuple[int, ...]) -> str:
    """The number of the first path that the last loop computes.

    >>> _path((2, 2, 2)), _path((2,))
    ('4 * i1 + 2 * i2', '0')
    """
    terms = [f"{prod(widths[level:])} * i{level}" for level in range(1, len(widths))]
    return " + ".join(terms) or "0"
