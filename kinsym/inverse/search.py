"""From the pool to a plan: always the cheapest step, and back when it leads nowhere.

Costs prefer few branches and determinants that cannot vanish. A dead end goes back to the next candidate, at most
BUDGET states in all, so that the verdict comes in bounded time and in the same order on every machine.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from kinsym.errors import NoClosedForm
from kinsym.inverse.assemble import assemble
from kinsym.inverse.plan import Item, Plan
from kinsym.inverse.pool import Pool, PoolEquation
from kinsym.inverse.rules import LAST_RULES, RULES
from kinsym.inverse.rules.base import Candidate, Names, View
from kinsym.inverse.state import State, shortened, start
from kinsym.inverse.verdict import verdict
from kinsym.kinematics.chain import Chain
from kinsym.robot.model import Task

BUDGET = 60
WIDTH = 3


@dataclass
class _Search:
    budget: int
    deepest: State | None = field(default=None)

    def run(self, state: State, names: Names, items: tuple[Item, ...]) -> tuple[Item, ...] | None:
        """The items of a finished plan, or None if this way leads nowhere."""
        while (step := shortened(state)) is not None:
            state, window = step
            items = (*items, window) if window else items
        left = state.known.unknowns()
        if not left:
            return items
        if self.deepest is None or len(left) < len(self.deepest.known.unknowns()):
            self.deepest = state
        for candidate in ranked(state)[:WIDTH]:
            if self.budget <= 0:
                return None
            self.budget -= 1
            branch = Names(set(names.taken), dict(names.counts), names.steps)
            outcome = candidate.build(branch)
            found = self.run(replace(state, known=outcome.known), branch, (*items, *outcome.items))
            if found is not None:
                return found
        return None


def ranked(state: State) -> list[Candidate]:
    """The candidates of a state, best first, one for each unknown and cost.

    The dearest rules are asked only if the others propose fewer than are ever tried.
    """
    pool = Pool(state)
    equations: list[PoolEquation] = []
    for cut in pool.cuts():
        equations += [equation for equation in pool.equations(cut) if equation.unknowns <= 2]
    view = View(state, equations)
    best: dict[tuple[int, str], Candidate] = {}
    for rules in (RULES, LAST_RULES):
        found = sorted((c for rule in rules for c in rule.candidates(view)), key=lambda c: c.order)
        for candidate in found:
            best.setdefault((candidate.cost, candidate.unknown), candidate)
        if len(best) >= WIDTH:
            break
    return list(best.values())


def derive_plan(chain: Chain, task: Task, *, budget: int = BUDGET) -> Plan:
    """The inverse kinematics of a chain for a task; ``budget`` is the number of states to try.

    Raises :class:`NoClosedForm` with the joints that are left and the geometry that blocks them.
    """
    state, window = start(chain, task)
    search = _Search(budget)
    items = search.run(state, Names(set(chain.ring.index)), (window,) if window else ())
    if items is None:
        raise NoClosedForm(verdict(search.deepest or state))
    return assemble(chain, task, items)
