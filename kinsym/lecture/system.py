"""What kinsym derives for a system of the lecture: links, products of neighbouring links, the pose.

All of it is taken as it is printed, so that what is compared with the lecture is what a user of kinsym sees.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from importlib import resources
from pathlib import Path

from sympy import Integer

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import transpose
from kinsym.algebra.tree import ONE, ZERO
from kinsym.kinematics.chain import Chain, build_chain
from kinsym.kinematics.forward import Forward, Matrix, forward_kinematics
from kinsym.kinematics.links import Rigid
from kinsym.lecture.quantities import Value
from kinsym.robot import gallery, load
from kinsym.robot.model import Convention, Home, Robot


@dataclass(frozen=True)
class Derived:
    """A matrix as kinsym prints it, with the chain whose names it uses.

    ``links`` are the rows it is the product of. ``general`` is how kinsym prints it where the chain is only an example.
    """

    chain: Chain
    matrix: Matrix
    links: tuple[int, ...]
    general: Matrix | None = None


class System:
    """A robot of the lecture; frame k follows joint k.

    >>> system("scara").robot.variables
    ('theta1', 'theta2', 'd3', 'theta4')
    """

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self._found: dict[tuple[int, int], Derived] = {}

    @property
    def fixed(self) -> Mapping[str, Value]:
        """Names that have the same value at every posture."""
        return {}

    @property
    def screws(self) -> bool:
        """Whether the links are screw displacements, which act on the home pose."""
        return self.robot.convention is Convention.SCREW

    @cached_property
    def chain(self) -> Chain:
        """The chain of the whole arm."""
        return build_chain(self.robot)

    @cached_property
    def forward(self) -> Forward:
        """The forward kinematics of the whole arm."""
        return forward_kinematics(self.chain)

    @property
    def pose(self) -> Derived:
        """The pose of the end effector."""
        return Derived(self.chain, self.forward.pose, tuple(range(1, len(self.robot.joints) + 1)))

    @property
    def base(self) -> Derived:
        """The base frame in itself."""
        rows = tuple(tuple(ONE if i == k else ZERO for k in range(4)) for i in range(4))
        return Derived(self.chain, rows, ())

    def link(self, number: int) -> Derived:
        """The link transform or the screw displacement of one row of the table."""
        return Derived(self.chain, self.forward.links[number - 1].matrix, (number,))

    def part(self, first: int, last: int) -> Derived:
        """The product of the links first + 1 to last, derived as an arm of its own."""
        key = first, last
        if key not in self._found:
            if last == first + 1:
                self._found[key] = self.link(last)
            else:
                self._found[key] = self._product(first, last)
        return self._found[key]

    def _product(self, first: int, last: int) -> Derived:
        chain = build_chain(rows_of(self.robot, first, last))
        return Derived(chain, forward_kinematics(chain).pose, tuple(range(first + 1, last + 1)))

    def inverse(self, first: int, last: int) -> Derived:
        """The inverse of such a product."""
        chain = build_chain(rows_of(self.robot, first, last))
        forward = forward_kinematics(chain)
        u, v, w, p = forward.columns
        back = Rigid(transpose((u, v, w)), p).inverse(chain.ring)
        rows = tuple(
            (*(nested(chain.ring, entry) for entry in row), nested(chain.ring, moved))
            for row, moved in zip(back.rotation, back.translation, strict=True)
        )
        return Derived(chain, (*rows, forward.pose[3]), (last, first))


def rows_of(robot: Robot, first: int, last: int) -> Robot:
    """Some rows of a table as a robot; the home pose of screws becomes the base frame, so that T is a displacement."""
    return replace(
        robot,
        joints=robot.joints[first:last],
        home=base_frame() if robot.convention is Convention.SCREW else None,
        base=None,
        tool=None,
        locks={},
    )


def base_frame() -> Home:
    """The end effector's home pose in the base frame."""
    zero, one = Integer(0), Integer(1)
    return Home(u0=(one, zero, zero), v0=(zero, one, zero), w0=(zero, zero, one), q0=(zero, zero, zero))


def _folder() -> Path:
    return Path(str(resources.files("kinsym.lecture"))) / "robots"


@lru_cache(maxsize=32)
def system(name: str) -> System:
    """The system of a robot of the gallery or of the lecture's own; it is derived once."""
    return System(load(name) if name in gallery() else load(str(_folder() / f"{name}.toml")))
