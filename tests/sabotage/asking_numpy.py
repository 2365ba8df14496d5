"""Everything that a generated NumPy module says."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import partial
from types import ModuleType
from typing import Any

import numpy as np

from kinsym.check.calls import calls_of
from kinsym.check.numpy_solver import NumpySolver
from kinsym.check.solvers import Floats
from kinsym.emit.schedule import Schedule
from tests.sabotage.asking import controller, say
from tests.sabotage.inputs import Inputs, broken_parameters, broken_vectors
from tests.sabotage.transcript import Transcript, behind_each_other

_NAMES = ("NAME", "JOINTS", "JOINT_TYPES", "PARAMETERS", "TASK", "MAX_SOLUTIONS", "BRANCHES", "LIMITS")


def of_numpy(module: ModuleType, schedule: Schedule, inputs: Sequence[Inputs]) -> Transcript:
    """What a module says to the inputs of every choice of parameters."""
    told: Transcript = {name: repr(getattr(module, name, None)) for name in _NAMES}
    for number, each in enumerate(inputs):
        parameters = {name: Fraction(value) for name, value in each.parameters.items()}
        solver = NumpySolver(module, schedule, parameters)
        answers = controller(calls_of(solver), each)
        _ordinary(answers, solver, each)
        _odd(answers, solver, each)
        told.update({f"{label} of choice {number}": answer for label, answer in answers.items()})
    return told


def _ordinary(told: Transcript, solver: NumpySolver, each: Inputs) -> None:
    """What the functions are for; a joint that is free has a reference, or none."""
    module, q, T = solver.module, each.q, each.T
    many = np.concatenate([q, each.turned])
    say(told, "fk", module.fk, many, **each.parameters)
    say(told, "jacobian", module.jacobian, many, **each.parameters)
    say(told, "near solutions", partial(_batch, solver), T, q, reference=q)
    say(told, "plain solutions", partial(_batch, solver), T, np.where(each.judge.kinematics.free, 0.0, q))
    rows = each.ordinary
    say(told, "ik", lambda: behind_each_other(module.ik(T[row], **solver.given(q[row])) for row in rows))
    shaped = solver.given(q[rows[:4]].reshape(2, 2, -1))
    say(told, "one and many", module.ik_batch, T[rows[:4]].reshape(2, 2, 4, 4), **shaped)


def _odd(told: Transcript, solver: NumpySolver, each: Inputs) -> None:
    """What only a module can be asked out of order: shapes, words, and calls that are no controller's."""
    module, row = solver.module, each.ordinary[0]
    q, T = each.q[row], each.T[row]
    given = solver.given(q)
    calls = (module.ik, module.ik_batch, module.solve, module.within)
    for name, pose in {**each.odd, "a row": T[0], "words": np.array([["x"] * 4] * 4)}.items():
        for call in calls:
            say(told, f"{call.__name__} of {name}", call, pose, **given)
        say(told, f"nearest of {name}", module.nearest, pose, q, **given)
    for k, broken in enumerate(broken_parameters(each.parameters)):
        for call in (module.fk, module.jacobian):
            say(told, f"{call.__name__} with parameters {k}", call, q, **broken)
    for k, near in enumerate((*broken_vectors(q), q[:-1], "x")):
        for call in calls:
            say(told, f"{call.__name__} near {k}", call, T, reference=near, **given)
    say(told, "the number of a bad pose", module.ik_batch, np.array([T, T, each.odd["zero rotation"], T]), **given)
    values = {item: value for item, value in dict(module.PARAMETERS).items() if value is not None}
    left = {name: value for name, value in given.items() if name not in values}
    for call in calls:
        say(told, f"{call.__name__} with defaults", call, T, reference=q, **left)
    say(told, "nearest with defaults", module.nearest, T, q, **left)
    for k, many in enumerate((q[:-1], np.array([["x"]]))):
        for call in (module.fk, module.jacobian):
            say(told, f"{call.__name__} of shape {k}", call, many, **each.parameters)


def _batch(solver: NumpySolver, T: Floats, q: Floats, **more: Any) -> Any:
    return solver.module.ik_batch(T, **more, **solver.given(q))[0]
