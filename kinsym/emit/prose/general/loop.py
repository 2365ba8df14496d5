"""The words that every solver without a closed form needs: the loop that the pose closes, and the last corrections."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kinsym.emit.prose.general.stage import Formula, Naming, Stage, inline
from kinsym.general.arm import TILT
from kinsym.general.plan import Cut, GeneralPlan

if TYPE_CHECKING:
    from kinsym.derivation import Derivation


class Loop:
    """The words of one plan."""

    def __init__(self, derivation: Derivation, plan: GeneralPlan, name: Naming) -> None:
        self.plan, self.name = plan, name
        self.cuts = plan.cuts or tuple(Cut.before(number) for number in plan.suppressed)
        self.cut = self.cuts[0]
        self.locked = tuple(derivation.robot.locks)
        virtual = ["phi"] if plan.virtual else []
        self.variables = [joint.variable for joint in derivation.solved.joints] + virtual
        self.turns = {
            angle.terms[0][0]: (angle.cosine, angle.sine)
            for angle in derivation.solved.angles.values()
            if len(angle.terms) == 1
        } | dict.fromkeys(virtual, ("cphi", "sphi"))

    def _variable(self, k: int) -> str:
        """The variable of joint Nk of the cut."""
        return self.variables[self.cut.order[k] - 1]

    def _kind(self, k: int) -> str:
        return self.plan.kinds[self.cut.order[k] - 1]

    def _loop(self) -> Stage:
        first, *others = range(1, 7)
        text = " ".join(["B", *(f"M{k} L{k}" for k in (first, *others))])
        closed = " ".join([*(f"M{k} L{k}" for k in range(1, 6)), "M6 G"])
        product, loop = self._chain(self.cut)
        way = "backward" if self.cut.backward else "forward"
        body: list[str | Formula] = [
            "{Mi} is the motion of joint {i} about or along its axis, {Li} the constant transform that follows it,"
            " {B} the one before the first joint:",
            Formula(("T", text), ("T", tex_product(text))),
            "The pose closes the arm to a loop of six joints:",
            Formula(("G", "L6 T^-1 B"), ("G", r"L_{6} T^{-1} B")),
            Formula((closed, "I"), (tex_product(closed), "I")),
            f"Opened behind joint {self.cut.dropped} and gone round {way} it reads",
            Formula((product, "I"), (loop, "I")),
        ]
        if self.locked:
            body.insert(
                0,
                f"The joints are counted without {' and '.join('{' + name + '}' for name in self.locked)}: what is"
                " locked is part of a constant transform.",
            )
        if self.plan.spin:
            body.insert(
                0,
                "Joint 6 is none of the robot: it turns the tool about its own axis by an angle {phi}, which the"
                " task leaves open.",
            )
        if self.plan.gate:
            axis = ", ".join(f"{row[2]}/7" for row in TILT)
            body[:0] = [
                "Five joints reach few poses. Joint 6 is none of the robot: it turns the tool by an angle {phi} about"
                " an axis through its origin that has no special direction, in the tool's frame",
                Formula(("e", f"({axis})"), ("e", f"({axis})")),
                "{L5} turns to this axis as well, and {L6} back. So a pose in general has solutions, and where {phi}"
                " vanishes the five joints reach it by themselves.",
            ]
        return Stage((), "the loop", tuple(body))

    def _factor(self, cut: Cut, k: int) -> tuple[str, str]:
        """Nk and Kk as text."""
        joint, link = f"M{cut.order[k]}", "G" if cut.links[k] == 6 else f"L{cut.links[k]}"
        return (f"{joint}^-1", f"{link}^-1") if cut.backward else (joint, link)

    def _chain(self, cut: Cut) -> tuple[str, str]:
        text = " ".join(part for k in range(6) for part in self._factor(cut, k))
        return text, tex_product(text)

    def _polish(self) -> Stage:
        body = [
            "Newton's method with the Jacobian brings every solution onto the pose. What stays off it by more than"
            " {1e-10} of the arm's length is none; what comes twice is returned once."
        ]
        if self.plan.gate:
            body.append(
                "Those in which {phi} vanishes are the robot's: its own joints are polished once more without the sixth"
                " and must come within {1e-9} of the pose."
            )
        if len(self.cuts) > 1:
            other = self.cuts[1]
            way = "backward" if other.backward else "forward"
            unknown = inline(self.variables[other.suppressed - 1])
            body.append(
                "Where a root has no solution of its own, or several have the same, the loop is opened a second time,"
                f" behind joint {other.dropped} and {way}, with {unknown} as the unknown of the polynomial; where that"
                " does not settle it, at a pose beside this one, from which Newton's method leads back."
            )
        body.append(f"Solutions are sorted by {inline(self.variables[0])}, then {inline(self.variables[1])} and so on.")
        return Stage((), "polished, sorted", tuple(body))


def inverse(factor: str) -> str:
    """A factor of a product turned round.

    >>> inverse("L4"), inverse("G^-1")
    ('L4^-1', 'G')
    """
    return factor.removesuffix("^-1") if factor.endswith("^-1") else f"{factor}^-1"


def tex_product(text: str) -> str:
    """``M4 L4 G^-1`` for LaTeX."""
    factors = []
    for factor in text.split():
        name = factor.removesuffix("^-1")
        digits = name.lstrip("MLGBT")
        letter = name[: len(name) - len(digits)]
        factors.append(letter + (f"_{{{digits}}}" if digits else "") + ("^{-1}" if factor.endswith("^-1") else ""))
    return " ".join(factors)
