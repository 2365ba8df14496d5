"""Values of locked joints at which every posture is singular.

The cosine and sine of a joint that is an input of the solver are constants of the arm that is solved, so a factor in
them alone is no condition on the posture: it is one on what the caller may give.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Poly
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.singular.conditions import Arm, Condition
from kinsym.kinematics.singular.meaning import Meaning
from kinsym.kinematics.singular.posture import posture
from kinsym.kinematics.singular.zeros import QUARTERS, Part, Zero


def given_conditions(arm: Arm, factors: Iterable[Poly], *, square: bool) -> Iterator[Condition]:
    """The factors of a constant that values of inputs make zero, and the arm singular with them.

    Of a ``square`` Jacobian every factor counts. A larger one loses rank for certain where all its minors vanish, so
    a factor of one of them is tried out, which takes a cosine, a sine or a length by itself.
    """
    chain = arm.chain
    given = inputs(chain)
    for factor in factors:
        names = chain.ring.used(factor)
        variables = {given[name] for name in names if name in given}
        alone = len(names) == 1 and factor == chain.ring[names[0]]
        if not variables or not (square or alone):
            continue
        zeros = _zeros(factor, names[0], given[names[0]]) if alone else ((Part(factor),),)
        if square or all(_loses(arm, names[0], part) for (part,) in zeros):
            yield Condition(
                polys=(factor,),
                values=(nested(chain.ring, factor),),
                power=1,
                zeros=zeros,
                whole=True,
                meaning=Meaning("", f"with {_joints(chain, variables)} locked there, every pose is singular"),
            )


def inputs(chain: Chain) -> dict[str, str]:
    """The generators that stand for the value of an input, each with the joint variable."""
    labels = {str(cell): label for cell, label in chain.constants.angles.items()}
    found: dict[str, str] = {}
    for variable, value in chain.robot.locks.items():
        if value is None:
            label = labels.get(variable)
            found |= {f"c{label}": variable, f"s{label}": variable} if label else {variable: variable}
    return found


def _zeros(factor: Poly, name: str, variable: str) -> tuple[Zero, ...]:
    """The values of an input at which its cosine, its sine or it itself is zero."""
    if name == variable:
        return ((Part(factor, variable),),)
    return tuple((Part(factor, variable, quarters),) for quarters in ((1, 3) if name[0] == "c" else (0, 2)))


def _loses(arm: Arm, name: str, part: Part) -> bool:
    """Whether J has lost a motion at random postures with an input at one of these values."""
    c, s = QUARTERS[part.quarters]
    value = {name: 0} if name == part.variable else {f"c{name[1:]}": c, f"s{name[1:]}": s}
    return all(arm.loses(posture(arm.chain, {**one.values, **value})) for one in arm.ordinary)


def _joints(chain: Chain, variables: set[str]) -> str:
    numbers = [str(number) for number, name in enumerate(chain.robot.variables, start=1) if name in variables]
    return f"joint{'s' if len(numbers) > 1 else ''} {' and '.join(numbers)}"
