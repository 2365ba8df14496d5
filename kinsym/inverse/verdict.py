"""Why there is no closed form: what is left, which axes fail to meet, what degree remains, what would help."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice

from kinsym.errors import DeadlineExceeded, RobotError
from kinsym.inverse.neighbours import MEET, PARALLEL, Change, Miss, changes, paul_table
from kinsym.inverse.state import State
from kinsym.kinematics.chain import Chain, build_chain
from kinsym.kinematics.tasks import mobility
from kinsym.robot.model import Robot, Task

DEGREES = {0: 16, 1: 16, 2: 8, 3: 2}
"""Solutions at most of an arm with six joints by the number of prismatic ones (Raghavan and Roth 1993)."""
TRIED = 2
"""How many changes of each kind are tried out."""

Solves = Callable[[Chain, Task], bool]


@dataclass(frozen=True)
class Verdict:
    """The answer where no rule applies; ``str(verdict)`` is the message.

    ``left`` and ``found`` are joint variables of the search that came farthest. What would help is computed, and tried
    out with ``solves``, only when it is asked for.
    """

    chain: Chain
    task: Task
    left: tuple[str, ...]
    found: tuple[str, ...]
    solves: Solves = field(repr=False, compare=False)

    @cached_property
    def table(self) -> Robot | None:
        """The arm as Paul's rows, None where they cannot be written exactly."""
        return paul_table(self.chain)

    @cached_property
    def possible(self) -> tuple[Change, ...]:
        """The changes that make three consecutive axes meet or parallel, the least first."""
        return tuple(changes(self.table, self.chain.numbers)) if self.table is not None else ()

    @property
    def misses(self) -> tuple[Miss, ...]:
        """What keeps the best triple of axes from meeting."""
        return next((change.misses for change in self.possible if change.effect == MEET), ())

    @cached_property
    def remedies(self) -> tuple[Change, ...] | None:
        """The least change that makes axes meet, and the least that makes them parallel, which give a closed form.

        None where the deadline left no time to try them out.
        """
        result: list[Change] = []
        try:
            for effect in (MEET, PARALLEL):
                some = [change for change in self.possible if change.effect == effect][:TRIED]
                result += islice(filter(self._helps, some), 1)
        except DeadlineExceeded:
            return None
        return tuple(result)

    def _helps(self, change: Change) -> bool:
        if self.table is None:
            return False
        try:
            chain = build_chain(change.made(self.table))
            return mobility(chain) == len(chain.joints) and self.solves(chain, self.task)
        except RobotError:
            return False

    @property
    def degree(self) -> int | None:
        """How many solutions an arm with these joints has at most; None where that is not known."""
        count, sliding = len(self.chain.joints), sum(joint.kind == "P" for joint in self.chain.joints)
        six = (count == 6 and self.task is Task.POSE) or (count == 5 and self.task is Task.POSITION_AXIS)
        return DEGREES.get(sliding) if six else None

    def __str__(self) -> str:
        head = f"no closed form for {', '.join(self.left)}"
        if self.found:
            head += f" ({', '.join(self.found)} can be found)"
        return f"{head}: {self._because()}{self._remedy()}{self._remains()}"

    def _because(self) -> str:
        if not self.misses:
            return "no rule applies to the equations that are left"
        reason = "no three consecutive axes meet or are parallel in a way that separates the joints: "
        return reason + ", ".join(map(str, self.misses))

    def _remedy(self) -> str:
        if self.table is None:
            return ""
        if self.remedies is None:
            return ". No time was left to try out which change of the table would give one"
        if not self.remedies:
            return ". No single triple of axes that met or were parallel would give one"
        first, *more = (str(change) for change in self.remedies)
        return f". {first[0].upper()}{first[1:]}{''.join(f', or {change}' for change in more)}: that has a closed form"

    def _remains(self) -> str:
        if self.degree is None:
            return ""
        return f". In general such an arm has up to {self.degree} solutions, the roots of one polynomial of that degree"


def verdict(state: State, solves: Solves) -> Verdict:
    """The verdict on a search that ended at a state; ``solves`` tells whether another arm has a closed form."""
    left = state.known.unknowns()
    found = tuple(joint.variable for joint in state.chain.joints if joint.variable not in left)
    return Verdict(state.chain, state.task, left, found, solves)
