"""Why there is no closed form: which joints are left, and which axes fail to meet.

Three consecutive axes i, i+1, i+2 meet in a point if a_i = a_{i+1} = 0 and d_{i+1} = 0 in Paul's table (Pieper 1968);
the triple that misses by the fewest lengths is the one worth naming.
"""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Expr

from kinsym.errors import RobotError
from kinsym.inverse.state import FIXED, State
from kinsym.kinematics.convert import paul_rows
from kinsym.kinematics.tasks import mobility


@dataclass(frozen=True)
class Miss:
    """Two axes that miss each other by a length of the table."""

    first: int
    second: int
    length: Expr

    def __str__(self) -> str:
        return f"axes {self.first} and {self.second} miss by {self.length}"


def verdict(state: State) -> str:
    """One message: what was found, what is left, what blocks it and what would help."""
    chain = state.chain
    left = state.known.unknowns()
    found = [joint.variable for joint in chain.joints if joint.variable not in left]
    head = f"no closed form for {', '.join(left)}"
    if found:
        head += f" ({', '.join(found)} can be found)"
    count, fixed = len(chain.joints), FIXED[state.task]
    if count > fixed:
        reason = f"{count} joints are more than the {fixed} that the task {state.task.value} fixes"
        return f"{head}: {reason}. Make {count - fixed} of them constant, or give a task with more equations"
    ways = mobility(chain)
    if ways < count:
        reason = f"the {count} joints move the end effector in only {ways} independent ways, at every pose"
        return f"{head}: {reason}. Make {count - ways} of the joints constant that others repeat"
    misses = blocking(state)
    if not misses:
        return f"{head}: no rule applies to the equations that are left. Three consecutive axes that meet would help"
    numbers = [number for miss in misses for number in (miss.first, miss.second)]
    axes = ", ".join(map(str, range(min(numbers), max(numbers) + 1)))
    zeros = " = ".join(dict.fromkeys(str(miss.length) for miss in misses))
    reason = "no three consecutive axes meet or are parallel in a way that separates the joints: "
    return f"{head}: {reason}{', '.join(map(str, misses))}. With {zeros} = 0 axes {axes} would meet"


def blocking(state: State) -> list[Miss]:
    """The lengths that keep the best triple of axes from meeting."""
    try:
        rows = paul_rows(state.chain)
    except RobotError:
        return []
    triples: list[list[Miss]] = []
    for i in range(len(rows) - 2):
        if any(row.kind == "P" for row in rows[i : i + 3]):
            continue
        lengths = ((i, i + 1, rows[i].a), (i + 1, i + 2, rows[i + 1].a), (i, i + 2, rows[i + 1].d))
        number = state.chain.numbers
        triples.append(
            [Miss(number[first], number[second], length) for first, second, length in lengths if length != 0]
        )
    triples = [triple for triple in triples if triple]
    return min(reversed(triples), key=len, default=[])
