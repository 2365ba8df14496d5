"""What the generated code needs of the nominal arm: its closed form as a function of its own, and when to trust it.

The closed form gives one start for each of its solutions. From there Newton's method with the true forward kinematics
converges quadratically, or the start is of no use. Solutions of the two arms go together one by one where no pose as
near as the deviation has another number of them: a root that is free, on a border, or beyond one by less than the band
is therefore a doubt, and so is a step that does not shrink, for its ratio to the one before is the deviation over the
distance from a singular pose.
"""

from __future__ import annotations

from typing import Any

from kinsym.algebra.tree import ZERO, Sym, sub
from kinsym.emit.printer import Printer
from kinsym.emit.schedule import NominalStarts, Schedule
from kinsym.emit.source.kernels import kernels_used
from kinsym.emit.source.needs import inverse_needs
from kinsym.emit.source.statements import KernelCall, inverse_views

STEPS = 6
"""Newton's steps before a start is given up; two or three are usual."""
SHRINK = 0.25
"""The largest share of the step before, of length 2 before the first, that is trusted."""
LAST = 1e-7
"""A step this short, in radians and units of the arm, leaves its square."""
MISSED = 1e-10
"""The square of the twist that may be missing before the last step: a short step far from the pose ends in a valley."""
APART = 1e-3
"""Solutions nearer than this may be one, or two of three."""


def nominal_names(schedule: Schedule, nominal: NominalStarts, printer: Printer) -> dict[str, Any]:
    """What the templates of either language read under ``starts``."""
    arm = nominal.schedule
    inverse = inverse_needs(arm)
    statements = inverse_views(arm, inverse, printer)
    joints = zip(arm.solution, nominal.offsets, schedule.solution, strict=True)
    values = [
        printer(Sym(name) if offset == ZERO else sub(Sym(name), offset))
        for name, offset, joint in joints
        if joint not in schedule.locked
    ]
    return {
        "inverse": inverse,
        "kernels": kernels_used(inverse.statements),
        "statements": statements,
        "size": arm.size,
        "tau": arm.tau,
        "near": nominal.band / arm.tau,
        "most": arm.maximum,
        "lanes": arm.maximum + arm.maximum % 2,
        "depth": arm.depth,
        "shape": "".join(f"{width}, " for width in reversed(arm.widths)),
        "axes": list(range(arm.depth, -1, -1)),
        "reals": [f"real{branch}" for branch in range(1, arm.depth + 1)],
        "marks": [view.mark for view in statements if isinstance(view, KernelCall)],
        "solution": values,
        "steps": STEPS,
        "shrink": repr(SHRINK),
        "last": repr(LAST),
        "missed": repr(MISSED),
        "apart": repr(APART),
    }
