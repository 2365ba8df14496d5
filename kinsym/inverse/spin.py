"""Position and axis as a whole pose: the arm gets one more joint about the axis that is to be placed.

Five joints that place a point p and a direction w are six that place a frame, the sixth turning about w through p: any
frame whose third column is w will do, and the sixth angle is not wanted. Whatever is known of arms with six joints,
three axes that meet or are parallel, then holds for five and that axis.
"""

from __future__ import annotations

from dataclasses import replace

from kinsym.algebra.nested import number
from kinsym.algebra.tree import ONE, Call, Definition, Pow, Quot, Sym, Tree, add, mul, opposite
from kinsym.inverse.plan import Plan, Step
from kinsym.inverse.rules.base import Names
from kinsym.kinematics.chain import Chain
from kinsym.robot.model import Task


def spin_name(chain: Chain) -> str:
    """What the joint is called: the next angle if the table does not use that name."""
    name = f"theta{len(chain.joints) + 1}"
    taken = {*chain.ring.index, *(joint.variable for joint in chain.joints)}
    while name in taken:
        name += "_"
    return name


def frame_about(names: Names) -> tuple[tuple[Definition, ...], dict[str, Tree]]:
    """Two columns that make a frame with w, and what the entries of the pose are called.

    Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin: Building an Orthonormal Basis, Revisited, JCGT 6 (2017).
    """
    x, y, z = (Sym(f"w_{row}") for row in "xyz")
    definitions: list[Definition] = []

    def named(stem: str, tree: Tree) -> Tree:
        definitions.append(Definition(name=names.fresh(stem), value=tree))
        return Sym(definitions[-1].name)

    sigma = named("sigma", Call("sign", (z,)))
    scale = named("lambda", Quot(number(-1), add(sigma, z)))
    entries: dict[str, Tree] = {}
    across = named("rho", mul(x, y, scale))
    entries["u_x"] = named("rho", add(ONE, mul(sigma, scale, Pow(x, 2))))
    entries["u_y"] = named("rho", mul(sigma, across))
    entries["u_z"] = named("rho", opposite(mul(sigma, x)))
    entries["v_x"] = across
    entries["v_y"] = named("rho", add(sigma, mul(scale, Pow(y, 2))))
    entries["v_z"] = named("rho", opposite(y))
    return tuple(definitions), entries


def without(plan: Plan, chain: Chain, spin: str) -> Plan:
    """The plan for position and axis: nobody gives a reference value of the added joint."""
    items = tuple(
        replace(item, reference=tuple(term for term in item.reference if term[0] != spin))
        if isinstance(item, Step)
        else item
        for item in plan.items
    )
    return replace(plan, task=Task.POSITION_AXIS, items=items)
