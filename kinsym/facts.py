"""What one line says of a robot: its class, its joints, how many solutions it has and whether in closed form.

The gallery's index and ``kinsym derive --json`` hold these; nothing of it is typed by hand.
"""

from __future__ import annotations

from typing import Any

from kinsym.derivation import Derivation
from kinsym.kinematics.arm_class import arm_class, joint_types


def facts(derivation: Derivation) -> dict[str, Any]:
    """The class of the joints that are solved for, all joints, the locked ones, the solutions at most.

    >>> from kinsym.deriving import derive
    >>> from kinsym.robot import load
    >>> facts(derive(load("planar_rr")))["class"]
    'planar'
    """
    solver = derivation.plan or derivation.general
    return {
        "class": arm_class(derivation.solved),
        "joints": joint_types(derivation.chain),
        "locked": list(derivation.robot.locks),
        "solutions": solver.maximum if solver else 0,
        "closed_form": derivation.plan is not None,
    }
