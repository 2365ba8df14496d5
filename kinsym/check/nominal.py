"""Where the checks look at an arm that is solved through its nominal one: next to that arm's singular poses.

There a joint of the nominal arm is free or two of its branches meet, while the true arm has solutions of its own, more
or fewer; nothing is lost at other poses as long as nothing is lost here.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from kinsym.check.evaluate import compiled, floating
from kinsym.check.poses import KINDS, NOMINAL, SINGULAR, Counts, Samples, held_samples, wrapped
from kinsym.check.singular import volume_of
from kinsym.check.solvers import Floats
from kinsym.check.task import task_jacobian
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.emit.schedule import NominalStarts


def with_nominal_samples(
    samples: Samples, nominal: NominalStarts, kinematics: TreeKinematics, counts: Counts, rng: np.random.Generator
) -> Samples:
    """Samples with as many more of the kind :data:`NOMINAL` as there are singular ones.

    ``kinematics`` are those of the true arm, whose joint values are the nominal arm's less the offsets.
    """
    arm = nominal.schedule
    values = {parameter.name: parameter.value for parameter in arm.parameters if parameter.value is not None}
    own = TreeKinematics(arm, values)

    def volume(q: Floats) -> Floats:
        slope = task_jacobian(own.jacobian(q), own.forward(q), arm.task, own.size)
        return volume_of(slope[..., own.free])

    wanted = Counts(uniform=0, quarter=0, singular=counts.singular, pair=0)
    found = held_samples(arm, volume, own.size, wanted, rng)
    rows = found.of(SINGULAR)
    ahead = np.array([float(compiled(value, floating())({})) for value in nominal.offsets])
    revolute = np.array([joint.kind == "R" for joint in arm.joints])
    q = wrapped(found.q[rows] - np.where(kinematics.free, ahead, 0.0), revolute)
    return replace(
        samples,
        q=np.concatenate([samples.q, q]),
        kind=np.concatenate([samples.kind, np.full(len(q), KINDS.index(NOMINAL))]),
        offset=np.concatenate([samples.offset, np.full(len(q), np.inf)]),
    )
