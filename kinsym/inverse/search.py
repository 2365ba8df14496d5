"""From the pool to a plan: always the cheapest step, and back when it leads nowhere.

Costs prefer few branches and determinants that cannot vanish. A dead end goes back to the next candidate, at most
BUDGET states in all, so that the verdict comes in bounded time and in the same order on every machine.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice

from kinsym.algebra.tree import Sym, Tree
from kinsym.deadline import Deadline
from kinsym.errors import NoClosedForm
from kinsym.inverse.assemble import assemble
from kinsym.inverse.nonzero import nonzero
from kinsym.inverse.plan import Item, Plan
from kinsym.inverse.pool import Pool, PoolEquation
from kinsym.inverse.rules import LAST_RULES, RULES, Rule
from kinsym.inverse.rules.base import Candidate, Names, View
from kinsym.inverse.spin import frame_about, spin_name, without
from kinsym.inverse.state import FIXED, NO_LIMIT, State, shortened, start
from kinsym.inverse.substitution import substituted
from kinsym.inverse.verdict import verdict
from kinsym.kinematics.chain import Chain, chain_to_solve
from kinsym.robot.model import Task

BUDGET = 60
TRIAL = 15
"""States that are spent on an arm of which only is asked whether it has a closed form."""
WIDTH = 3
"""How many candidates of a state are tried."""


@dataclass
class _Search:
    budget: int
    deepest: State | None = field(default=None)
    dead: set[tuple[object, ...]] = field(default_factory=set)

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
        state.deadline.note(reached(self.deepest))
        here = (state.first, state.end, state.known.edges, state.known.lengths)
        if here in self.dead:
            return None
        for candidate in islice(ranked(state), WIDTH):
            if self.budget <= 0:
                return None
            self.budget -= 1
            branch = Names(set(names.taken), dict(names.counts), names.steps)
            outcome = candidate.build(branch)
            found = self.run(replace(state, known=outcome.known), branch, (*items, *outcome.items))
            if found is not None:
                return found
        self.dead.add(here)
        return None


def ranked(state: State) -> Iterator[Candidate]:
    """The candidates of a state, best first, one for each unknown and cost.

    The dearest rules are asked only when the others lead nowhere.
    """
    seen: set[tuple[int, str]] = set()
    for rules, view in stages(state):
        found: list[Candidate] = []
        for rule in rules:
            for candidate in rule.candidates(view):
                state.deadline.check()
                found.append(candidate)
        for candidate in sorted(found, key=lambda c: c.order):
            if (candidate.cost, candidate.unknown) not in seen:
                seen.add((candidate.cost, candidate.unknown))
                yield candidate


def stages(state: State) -> Iterator[tuple[Sequence[Rule], View]]:
    """Rules with what they look at, the dearest last: equations of the pool, then those without some length."""
    pool = Pool(state)
    everything: list[PoolEquation] = []
    for cut in pool.cuts():
        state.deadline.check()
        everything += pool.equations(cut)
    view = View(state, [equation for equation in everything if equation.unknowns <= 2 or not equation.angles])
    yield RULES, view
    yield LAST_RULES, view
    fewer = substituted(state, everything)
    if fewer:
        yield (*RULES, *LAST_RULES), View(state, fewer)


def reached(state: State) -> str:
    """How far the search has come at best."""
    left = state.known.unknowns()
    found = [joint.variable for joint in state.chain.joints if joint.variable not in left]
    return f"{', '.join(found)} found, {', '.join(left)} left" if found else f"no way yet to {', '.join(left)}"


def derive_plan(chain: Chain, task: Task, deadline: Deadline = NO_LIMIT, *, budget: int = BUDGET) -> Plan:
    """The inverse kinematics of a chain for a task; ``budget`` is the number of states to try.

    Raises :class:`NoClosedForm` with the joints that are left and the geometry that blocks them, and
    :class:`kinsym.errors.DeadlineExceeded` when the time is over.
    """
    plan, state = _plan(chain, task, deadline, budget)
    if plan is None:
        raise NoClosedForm(verdict(state, lambda other, task: _plan(other, task, deadline, TRIAL)[0] is not None))
    return plan


def _plan(chain: Chain, task: Task, deadline: Deadline, budget: int) -> tuple[Plan | None, State]:
    """The plan, or None, and the state that came farthest."""
    state, window = start(chain, task, deadline)
    search = _Search(budget)
    items = search.run(state, Names(set(chain.ring.index)), (window,) if window else ())
    plan = None if items is None else assemble(chain, task, items)
    if plan is not None:
        return replace(plan, nonzero=nonzero(chain, plan)), search.deepest or state
    if task is Task.POSITION_AXIS and len(chain.joints) == FIXED[task]:
        plan = _with_spin(chain, deadline, budget)
    return plan, search.deepest or state


def _with_spin(chain: Chain, deadline: Deadline, budget: int) -> Plan | None:
    """Position and axis as a whole pose of the arm with a joint more, see :mod:`kinsym.inverse.spin`."""
    name = spin_name(chain)
    state, names, frame, entries = spun_start(chain, deadline)
    spun = state.chain
    items = _Search(budget).run(state, names, frame)
    if items is None:
        return None
    plan = assemble(spun, Task.POSE, items, unread=(name,))
    aliases = {tree.name: entry for entry, tree in entries.items() if isinstance(tree, Sym)}
    return replace(without(plan, chain, name), nonzero=nonzero(spun, plan, aliases))


def spun_start(chain: Chain, deadline: Deadline = NO_LIMIT) -> tuple[State, Names, tuple[Item, ...], dict[str, Tree]]:
    """Where the search for a position and an axis begins, with the items before it and the names of the pose."""
    spun = chain_to_solve(chain.robot, spin_name(chain))
    names = Names({*spun.ring.index, *chain.ring.index})
    frame, entries = frame_about(names)
    state, window = start(spun, Task.POSE, deadline, entries)
    return state, names, (*frame, *((window,) if window else ())), entries
