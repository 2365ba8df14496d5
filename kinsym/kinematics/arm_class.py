"""What an arm is called by its geometry: spherical wrist, three parallel axes, planar, general 6R.

Three consecutive revolute axes that meet in a point (a slide between them may lie along one of them) or are parallel
are the two classes of Pieper (The kinematics of
manipulators under computer control, 1968) that have a closed form whatever the other joints are; an arm that falls in
both is called by its wrist. Whether axes meet or are parallel is seen at random postures modulo the prime.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

from kinsym.algebra.linear import cross, difference, dot
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.singular.meaning import crossing
from kinsym.kinematics.singular.posture import Posture
from kinsym.kinematics.singular.zeros import somewhere

_POSTURES = 3
#: An arm with so many joints and none of the classes is a general one.
_GENERAL = 5


def joint_types(chain: Chain) -> str:
    """The joints of a chain from the base on: ``"RRPR"``.

    >>> from kinsym.kinematics.chain import build_chain
    >>> from kinsym.robot import load
    >>> joint_types(build_chain(load("scara")))
    'RRPR'
    """
    return "".join(joint.kind for joint in chain.joints)


def arm_class(chain: Chain) -> str:
    """The class of the joints of a chain; for a robot with locked joints give the chain that is solved.

    >>> from kinsym.kinematics.chain import build_chain
    >>> from kinsym.robot import load
    >>> [arm_class(build_chain(load(name))) for name in ("puma560", "ur5", "scara", "ufactory_xarm6")]
    ['spherical wrist', 'three parallel axes', 'SCARA', 'general 6R']
    """
    arm = _Arm(somewhere(chain, _POSTURES))
    kinds = joint_types(chain)
    if not arm.turning:
        return "gantry"
    if arm.all_parallel(arm.turning):
        return arm.with_parallel_axes()
    if "P" not in kinds and arm.all_meet(arm.turning):
        return "spherical wrist" if len(kinds) == 3 else "all axes meet"
    triples = list(zip(arm.turning, arm.turning[1:], arm.turning[2:], strict=False))
    meeting = [triple for triple in triples if arm.all_meet(triple)]
    if meeting:
        if meeting[-1][-1] == len(kinds) - 1:
            return "spherical wrist"
        first = meeting[0]
        return "spherical shoulder" if first[0] == arm.turning[0] else f"axes {', '.join(arm.numbers(first))} meet"
    if any(map(arm.all_parallel, triples)):
        return "three parallel axes"
    if kinds.count("P") >= 3:
        return "three slides"
    if len(kinds) < _GENERAL and any(map(arm.all_parallel, pairwise(arm.turning))):
        return "two parallel axes"
    if len(kinds) < _GENERAL and any(map(arm.all_meet, pairwise(arm.turning))):
        return "two axes that meet"
    return "general " + "".join(f"{count}{kind}" for kind in "RP" if (count := kinds.count(kind)))


class _Arm:
    """An arm at a few random postures; joints are counted from 0."""

    def __init__(self, postures: list[Posture]) -> None:
        self._postures = postures
        self.turning = [joint for joint, kind in enumerate(postures[0].kinds) if kind == "R"]

    def numbers(self, joints: Sequence[int]) -> list[str]:
        """Joints as the table counts them."""
        return [str(self._postures[0].numbers[joint]) for joint in joints]

    def with_parallel_axes(self) -> str:
        """The class of an arm whose revolute axes are all parallel, by the directions of its slides."""
        sliding = [joint for joint, kind in enumerate(self._postures[0].kinds) if kind == "P"]
        along = [joint for joint in sliding if self.all_parallel((self.turning[0], joint))]
        across = [joint for joint in sliding if self._square(self.turning[0], joint)]
        if not along and across == sliding:
            return "planar"
        if len(self.turning) == 1:
            return "cylindrical" if along and across else "one turn and slides"
        return "SCARA" if along == sliding else "parallel axes and slides"

    def all_parallel(self, joints: Sequence[int]) -> bool:
        """Whether the axes are parallel in every posture."""
        return self._everywhere(lambda p: not any(any(cross(p.axes[joints[0]], p.axes[j])) for j in joints[1:]))

    def all_meet(self, joints: Sequence[int]) -> bool:
        """Whether the axes pass through one point in every posture, the first two from different directions."""
        return self._everywhere(lambda p: self._meet(p, joints))

    @staticmethod
    def _meet(posture: Posture, joints: Sequence[int]) -> bool:
        point = crossing(posture, joints[0], joints[1])
        if point is None:
            return False
        return not any(any(cross(posture.axes[j], difference(point, posture.points[j]))) for j in joints[2:])

    def _square(self, i: int, j: int) -> bool:
        return self._everywhere(lambda p: dot(p.axes[i], p.axes[j]) == 0)

    def _everywhere(self, holds: Callable[[Posture], bool]) -> bool:
        return all(map(holds, self._postures))
