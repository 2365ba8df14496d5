"""Which usable cut loses the fewest digits: measured on seeded poses with the code that will be generated.

Neither the condition of the equations nor that of the matrix at random angles predicts it, and a poor cut finds half
of the solutions, so every cut solves the same poses.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from types import ModuleType
from typing import TYPE_CHECKING, Any

from kinsym.deadline import Deadline
from kinsym.emit.live import live_module
from kinsym.general.plan import Cut, GeneralPlan
from kinsym.inverse.state import NO_LIMIT

if TYPE_CHECKING:
    from kinsym.emit.schedule import Schedule

FEW, MANY = 64, 300
"""Poses at which every cut is tried, and those at which the best are tried again."""
KEPT = 6
REACH = 3.0
"""How far a joint slides either way, in mean lengths of links."""
SEED = 6


def calibrated(schedule: Schedule, deadline: Deadline = NO_LIMIT) -> GeneralPlan | None:
    """The schedule's plan with the best of its cuts and the best that drops another joint or goes round otherwise.

    First come the solutions found; then how far they are off before they are polished, in decades rounded to a
    tenth, so that the choice is the same on every machine; then the order of the candidates. None if the best does not
    even find one solution for each pose.
    """
    plan = schedule.general
    if plan is None:
        return None
    cuts = plan.cuts or tuple(Cut.before(number) for number in plan.suppressed)
    score = _scores(schedule, deadline)
    order = sorted(range(len(cuts)), key=lambda number: (*score(number, FEW, 0), number))
    kept = order[:KEPT]
    if all(_loop(cuts[number]) == _loop(cuts[order[0]]) for number in kept):
        kept += [number for number in order[KEPT:] if _loop(cuts[number]) != _loop(cuts[order[0]])][:1]
    kept.sort(key=lambda number: (*score(number, MANY, 1), number))
    best = cuts[kept[0]]
    if -score(kept[0], MANY, 1)[0] < MANY:
        return None
    second = [cuts[number] for number in kept if _loop(cuts[number]) != _loop(best)]
    chosen = (best, *second[:1])
    if plan.suppressed:
        return replace(plan, suppressed=tuple(cut.suppressed for cut in chosen))
    return replace(plan, cuts=chosen)


def _loop(cut: Cut) -> tuple[int, bool]:
    return cut.dropped, cut.backward


def _scores(schedule: Schedule, deadline: Deadline) -> Callable[[int, int, int], tuple[int, float]]:
    """A function of a cut's number, a count of poses and a draw: minus the solutions found, and how good they are."""
    import numpy as np

    module = live_module(schedule)
    rng = np.random.Generator(np.random.PCG64(SEED))
    parameters = {
        parameter.name: float(rng.uniform(0.1, 1.0) if parameter.value is None else parameter.value)
        for parameter in schedule.parameters
    } | {name: float(rng.uniform(0.1, 1.0)) for name in schedule.inputs}
    drawn: dict[int, tuple[Any, Any]] = {}

    @cache
    def score(number: int, count: int, draw: int) -> tuple[int, float]:
        deadline.note("no closed form, the ways round the loop are compared")
        if draw not in drawn:
            drawn[draw] = _poses(module, parameters, count, SEED + 1 + draw)
        wanted, length = drawn[draw]
        with np.errstate(all="ignore"):
            pose, q, *_ = module._starts(module._CUTS[number], length, wanted, parameters)
            before = module._distance(module._reached(q, parameters), wanted[pose], length[pose])
            q, after = module._polished(q, wanted[pose], length[pose], parameters)
            good = after < module._ACCEPTED
            found = module._distinct(pose[good], q[good], after[good], wanted, length, parameters)[0]
            if not len(found):
                return 0, 0.0
            decades = np.log10(np.maximum(before[good], 1e-16))
        return -len(found), round(float(np.quantile(decades, 0.97) + 0.3 * decades.mean()), 1)

    return score


def _poses(module: ModuleType, parameters: dict[str, float], count: int, seed: int) -> tuple[Any, Any]:
    """Poses of random joint vectors, and their units of length."""
    import numpy as np

    rng = np.random.Generator(np.random.PCG64(seed))
    q = rng.uniform(-1.0, 1.0, (count, len(module._SLIDING)))
    links = module._links(**{name: parameters[name] for name in module._LINK_PARAMETERS})
    length = float(np.sqrt((links[1:6, :3, 3] ** 2).sum(axis=1)).mean())
    wanted = module._reached(q * np.where(module._SLIDING, REACH * length, np.pi), parameters)
    return wanted, module._lengths(wanted, parameters)
