"""Why a change can leave every answer as it is, by the part of the code that it stands in.

That an answer stays is found by asking; these are the reasons that a reader of the code finds behind it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from tests.sabotage import plan
from tests.sabotage.mutant import Mutant

SETTLED = "a root is moved onto its pose: other steps, starts and limits on the way end at the same root"
BANDS = "how near to a special pose a root is looked at more closely: nearly all are found either way"
POSE = "how far a rotation is off, a term that vanishes where it is one, or a limit that no pose lies on"
LANES = "what a batch takes at once: the rest is left to the function for one pose, which says the same"
ROUNDED = "the last digits of sines and angles, the ends of ranges that nothing reaches"
WINDINGS = "limits, ties and windings that no solution lies on"
SIZES = "in units of what size a length counts as zero; a value that is refused in another place as well"
STARTS = "a formula whose roots are moved onto the pose afterwards, a reference of what is never free"
REST = "something else"

#: The functions of both languages without the underscore, the arm's name and "scalar_" in front.
_FUNCTIONS = {
    SETTLED: "settle settled polish step stepped slopes distance tidied drop_copies starts refine newton advance",
    BANDS: "triangle linear direction homogeneous homogeneous2 quadratic quotient quartic linear_pole mark reaches "
    "reaches_pose reach_block length free joint_parts",
    POSE: "read_pose read_poses mended_pose read_block is_pose are_numbers",
    LANES: "ik_batch fk_batch solve_block fk_block in_blocks",
    ROUNDED: "wave angle_of angles_of angle wrap half_turn opposite",
    WINDINGS: "turns turns_of windings wound within nearest moved limits weights unwound all_intervals",
    SIZES: "regular usable check_nonzero check_parameters not_zero single array references reference given",
}
_REASONS = {function: reason for reason, functions in _FUNCTIONS.items() for function in functions.split()}


def reason_of(robot: str, mutant: Mutant) -> str:
    """Why answers may stay the same with a mutant of a robot."""
    if mutant.language == plan.LANGUAGE:
        return STARTS
    function = mutant.where.partition(",")[0].removeprefix(f"{robot}_").lstrip("_")
    function = re.sub("^(scalar|solve|lane)_(?!block)", "", function)
    return _REASONS.get(function, REST)


def reasons() -> Iterable[str]:
    """All of them, in the order in which they are told."""
    return (*_FUNCTIONS, STARTS, REST)
