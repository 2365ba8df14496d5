"""Singular poses in words, the same in the terminal, on paper and in the comments of the code."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from kinsym.algebra.tree import Tree
from kinsym.inverse.families import Family
from kinsym.kinematics.singular import Condition, SingularSet
from kinsym.robot.model import Task

Write = Callable[[Tree], str]

#: A factor with more terms than this is told, not printed.
LONGEST = 40

#: What the list of families is about.
FAMILIES = "Where a joint is free the solutions are a family, and the joint takes its reference value:"

_ROWS = {
    Task.POSITION: "the rows of the velocity",
    Task.ORIENTATION: "the rows of the angular velocity",
    Task.PLANAR: "the rows of the velocity in the plane and of the turn about its normal",
    Task.SCARA: "the rows of the velocity and of the turn about the vertical",
    Task.POSITION_AXIS: "the turn about the direction w as its sixth column",
}


def shown(singular: SingularSet) -> bool:
    """Whether det J is printed as a product: it is known, and none of its factors is too long to be read."""
    return singular.square and all(len(poly) <= LONGEST for one in singular.listed for poly in one.polys)


def introduction(singular: SingularSet) -> str:
    """What J is here, before its determinant or its conditions."""
    if singular.missing:
        return f"The singular poses are not listed: {singular.missing}."
    if not singular.square:
        return "The task asks for more than the joints can move, so J has more rows than columns."
    rows = _ROWS.get(singular.task)
    return f"J taken with {rows}." if rows else ""


def verdict(singular: SingularSet) -> str:
    """The sentence that the list of conditions follows, or that there is none."""
    subject = "Its rank falls" if not singular.square else "It vanishes" if shown(singular) else "det J vanishes"
    if singular.missing:
        return ""
    if not singular.listed:
        if not singular.exhaustive:
            return "Its rank falls only where several expressions vanish at once."
        constant = "It is never zero" if singular.square else "Its rank is full everywhere"
        return f"{constant}: the arm has no singular pose."
    return f"{subject}, and the arm is singular, where"


def remainder(singular: SingularSet) -> tuple[str, ...]:
    """What the list of conditions leaves open."""
    sentences = []
    if singular.conditions and not singular.exhaustive:
        sentences.append("Elsewhere the rank falls only where several other expressions vanish at once.")
    if singular.conditions and not singular.split:
        sentences.append("The longest factor was not searched for factors of its own: it has too many terms.")
    return tuple(sentences)


def heading(condition: Condition) -> str:
    """The name and the geometry of a condition.

    Where neither is known the condition has to speak for itself.
    """
    name, reason = condition.meaning.name, condition.meaning.reason
    if name and reason:
        return f"{name.capitalize()} singularity: {reason}"
    return f"{reason[:1].upper()}{reason[1:]}" if reason else "A factor without a simple meaning"


def equations(condition: Condition, write: Write, told: Callable[[str], str] = str) -> Iterator[tuple[str, str]]:
    """Left and right side of what must hold; ``told`` sets words among formulas.

    Of two expressions that count in one of their zeros only the joint value is what must hold.
    """
    doubled = len(condition.values) > 1
    for part, value in zip(condition.zeros[0], condition.values, strict=True):
        if doubled and not condition.whole and part.relation:
            yield write(part.relation[0]), write(part.relation[2])
            continue
        poly = part.poly
        long = len(poly) > LONGEST
        yield told(f"a factor of {len(poly)} terms") if long else write(value), "0"


def angles(condition: Condition, write: Write, either: str = " or ") -> str:
    """The joint values of a condition, if it is one joint's cosine or sine: theta5 = 0 or theta5 = pi."""
    relations = [zero[0].relation for zero in condition.zeros]
    if len(condition.values) > 1 or any(relation is None or relation[0] in condition.values for relation in relations):
        return ""
    return either.join(f"{write(left)} = {write(right)}" for left, _, right in filter(None, relations))


def leading_to(condition: Condition) -> str:
    """The words between a condition and its joint values."""
    return "so" if condition.whole else "but only for"


def family_conditions(family: Family, write: Write, apart: str = ", ") -> str:
    """Where a family is."""
    return apart.join(f"{write(left)} {sign} {write(right)}" for left, sign, right in family.conditions)


def follows(family: Family, write: Write, name: Callable[[str], str]) -> str:
    """One sentence about a family."""
    parts = [f"{name(family.free)} is free"]
    if family.folded:
        parts[0] += " if two links have the same length and lie folded on each other"
    if family.constant:
        parts.append(f"{listed([write(tree) for tree in family.constant])} {_stay(family.constant)} constant")
    if family.follows:
        verb = "follows" if len(family.follows) == 1 else "follow"
        parts.append(f"{listed([name(joint) for joint in family.follows])} {verb}")
    return "; ".join(parts)


def _stay(trees: Sequence[Tree]) -> str:
    return "stays" if len(trees) == 1 else "stay"


def listed(words: Sequence[str]) -> str:
    """Words in a row.

    >>> listed(["theta1", "theta2", "theta3"])
    'theta1, theta2 and theta3'
    """
    return f"{', '.join(words[:-1])} and {words[-1]}" if len(words) > 1 else "".join(words)
