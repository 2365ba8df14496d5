"""How a six-joint arm without a closed form is solved, in words and formulas, for the terminal and for paper.

The numbers of equations are those of Raghavan and Roth (1990): 14 equations, of which the products of two joints take
eight away, six in the monomials of three joints, a 12 x 12 matrix, degree 16.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kinsym.general.plan import Cut, GeneralPlan

if TYPE_CHECKING:
    from kinsym.derivation import Derivation

Naming = Callable[[str], str]
"""How a name of the program is written; on paper it becomes mathematics."""


@dataclass(frozen=True)
class Formula:
    """``left = right``, as plain text and for LaTeX."""

    text: tuple[str, str]
    tex: tuple[str, str]


@dataclass(frozen=True)
class Stage:
    """One numbered step: its unknowns, what happens to them, and sentences with formulas between them.

    In a sentence what stands in braces is mathematics.
    """

    unknowns: tuple[str, ...]
    title: str
    body: tuple[str | Formula, ...]


def stages(derivation: Derivation, plan: GeneralPlan, name: Naming) -> tuple[Stage, ...]:
    """The steps of a general plan in order; ``name`` writes names for LaTeX."""
    words = _TwoSlides if plan.suppressed else _General
    return tuple(words(derivation, plan, name).stages())


class _General:
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

    def stages(self) -> Iterator[Stage]:
        """All of them."""
        yield self._loop()
        yield self._equations()
        yield self._six()
        yield self._system()
        yield self._polynomial()
        yield self._null_vector()
        yield self._others()
        yield self._polish()

    def _variable(self, k: int) -> str:
        """The variable of joint Nk of the cut."""
        return self.variables[self.cut.order[k] - 1]

    def _kind(self, k: int) -> str:
        return self.plan.kinds[self.cut.order[k] - 1]

    def _monomials(self, k: int) -> tuple[str, str]:
        """(s4, c4, 1) or (d3, d3^2, 1), as text and for LaTeX."""
        variable = self._variable(k)
        if self._kind(k) == "P":
            return f"({variable}, {variable}^2, 1)", f"({self.name(variable)}, {self.name(variable)}^2, 1)"
        cosine, sine = self.turns[variable]
        return f"({sine}, {cosine}, 1)", f"({self.name(sine)}, {self.name(cosine)}, 1)"

    def _loop(self) -> Stage:
        first, *others = range(1, 7)
        text = " ".join(["B", *(f"M{k} L{k}" for k in (first, *others))])
        closed = " ".join([*(f"M{k} L{k}" for k in range(1, 6)), "M6 G"])
        product, loop = self._chain(self.cut)
        way = "backward" if self.cut.backward else "forward"
        body: list[str | Formula] = [
            "{Mi} is the motion of joint {i} about or along its axis, {Li} the constant transform that follows it,"
            " {B} the one before the first joint:",
            Formula(("T", text), ("T", _tex_product(text))),
            "The pose closes the arm to a loop of six joints:",
            Formula(("G", "L6 T^-1 B"), ("G", r"L_{6} T^{-1} B")),
            Formula((closed, "I"), (_tex_product(closed), "I")),
            f"Opened behind joint {self.cut.dropped} and gone round {way} it reads",
            Formula((product, "I"), (loop, "I")),
        ]
        if self.locked:
            body.insert(
                0,
                f"The joints are counted without {' and '.join('{' + name + '}' for name in self.locked)}: what is"
                " locked is part of a constant transform.",
            )
        if self.plan.virtual:
            body.insert(
                0,
                "Joint 6 is none of the robot: it turns the tool about its own axis by an angle {phi}, which the"
                " task leaves open.",
            )
        return Stage((), "the loop", tuple(body))

    def _factor(self, cut: Cut, k: int) -> tuple[str, str]:
        """Nk and Kk as text."""
        joint, link = f"M{cut.order[k]}", "G" if cut.links[k] == 6 else f"L{cut.links[k]}"
        return (f"{joint}^-1", f"{link}^-1") if cut.backward else (joint, link)

    def _chain(self, cut: Cut) -> tuple[str, str]:
        text = " ".join(part for k in range(6) for part in self._factor(cut, k))
        return text, _tex_product(text)

    def _sides(self) -> tuple[str, str]:
        """N2 K2 N3 K3 N4 K4, and the inverse of the rest without N5."""
        left = " ".join(part for k in (2, 3, 4) for part in self._factor(self.cut, k))
        right: list[str] = []
        for k in (1, 0):
            joint, link = self._factor(self.cut, k)
            right += [_inverse(link), _inverse(joint)]
        return left, " ".join([*right, _inverse(self._factor(self.cut, 5)[1])])

    def _equations(self) -> Stage:
        left, right = self._sides()
        m = [self._monomials(k) for k in range(5)]
        unknown = self._variable(5)
        return Stage(
            (unknown,),
            "dropped, 14 equations",
            (
                f"A turn by {_inline(unknown)} leaves the axis of joint {self.cut.dropped} where it is. So both sides"
                " of the loop do the same to this axis, and the angle is gone:",
                Formula(
                    (f"{left} psi0", f"{right} psi0"),
                    (f"{_tex_product(left)} \\, \\psi_{{0}}", f"{_tex_product(right)} \\, \\psi_{{0}}"),
                ),
                "A line of direction {l} through a point {p} is written as 15 numbers, which a motion {R, t} maps"
                " linearly; {psi0} is the {z} axis through the origin:",
                Formula(
                    ("psi", "(1, p, q, l, s, m, w),  q = p.p,  s = p.l,  m = p x l,  w = q l - 2 s p"),
                    (
                        r"\psi",
                        r"(1, p, q, l, s, m, w) , \quad q = p \cdot p ,\; s = p \cdot l ,\; m = p \times l ,\;"
                        r" w = q \, l - 2 s \, p",
                    ),
                ),
                Formula(
                    ("p'", "R p + t,  q' = q + 2 t.(R p) + t.t"),
                    ("p'", r"R p + t , \quad q' = q + 2 t \cdot R p + t \cdot t"),
                ),
                Formula(
                    ("l'", "R l,  s' = s + t.(R l),  m' = R m + t x (R l)"),
                    ("l'", r"R l , \quad s' = s + t \cdot R l , \quad m' = R m + t \times R l"),
                ),
                Formula(
                    ("w'", "R w - 2 t x (R m) + (t.t) R l - 2 s' t"),
                    ("w'", r"R w - 2 t \times R m + (t \cdot t) \, R l - 2 s' t"),
                ),
                "Its entries behind the 1 are 14 equations. On the left they are linear in the products of"
                f" {_inline(m[2][0])}, {_inline(m[3][0])} and {_inline(m[4][0])}, on the right in those of"
                f" {_inline(m[1][0])} and {_inline(m[0][0])}:",
                Formula(
                    ("P mu", "Q nu,  P 14 x 27, Q 14 x 8"),
                    (r"P \mu", r"Q \nu , \quad P\ 14 \times 27,\; Q\ 14 \times 8"),
                ),
            ),
        )

    def _six(self) -> Stage:
        return Stage(
            (self._variable(1), self._variable(0)),
            "eliminated, six equations",
            (
                "The eight products {nu} of these two joints are eliminated: an orthogonal transformation makes {Q}"
                " upper triangular, eight rows hold them and six do not:",
                Formula(("R nu", "P_1 mu"), (r"R \nu", r"P_{1} \mu")),
                Formula(("E mu", "0,  E 6 x 27"), (r"E \mu", r"0 , \quad E\ 6 \times 27")),
            ),
        )

    def _system(self) -> Stage:
        x, y, unknown = (self._variable(self._x), self._variable(self._y), self._variable(2))
        if self._kind(self._x) == "P":
            start = (Formula(("X", x), ("X", self.name(x))),)
        else:
            start = (Formula(("X", f"tan({x}/2)"), ("X", f"\\tan({self.name(x)}/2)")),)
        w_text, w_tex = self._monomials(self._y)
        where = "" if self._kind(self._x) == "P" else ", after a product with {1 + X^2},"
        return Stage(
            (x, y),
            "twelve equations",
            (
                f"The six equations are quadratic in {{X}}{where} and linear in {{W}}; {{A}}, {{B}} and {{C}} are"
                f" {{6 x 3}} and linear in the cosine and the sine of {_inline(unknown)}:",
                *start,
                Formula(("W", w_text), ("W", w_tex)),
                Formula(("(A X^2 + B X + C) W", "0"), (r"(A X^{2} + B X + C) \, W", "0")),
                "With these multiplied by {X} there are twelve equations in twelve products:",
                Formula(
                    ("M (X^3 W, X^2 W, X W, W)", "0,  M = [A B C 0; 0 A B C]"),
                    (
                        r"M \, (X^{3} W,\, X^{2} W,\, X W,\, W)",
                        r"0 , \quad M = \begin{bmatrix} A & B & C & 0 \\ 0 & A & B & C \end{bmatrix}",
                    ),
                ),
            ),
        )

    @property
    def _x(self) -> int:
        return 4 if self.cut.shift else 3

    @property
    def _y(self) -> int:
        return 3 if self.cut.shift else 4

    def _polynomial(self) -> Stage:
        unknown = self._variable(2)
        name = self.name(unknown)
        body: list[str | Formula] = []
        if self.cut.bordered:
            body += [
                "The arm is its own mirror image: {M} loses two ranks at a solution, so its determinant has double"
                " roots alone. With a fixed column {b} and a fixed row {c} around it the roots are simple:",
                Formula(
                    (f"f({unknown})", "det [M b; c 0] = 0"),
                    (f"f({name})", r"\det \begin{bmatrix} M & b \\ c & 0 \end{bmatrix} = 0"),
                ),
                "What is then no solution has a matrix {M} of rank 11 or 12 and is left out.",
            ]
        else:
            body.append(Formula((f"f({unknown})", "det M = 0"), (f"f({name})", r"\det M = 0")))
        cosine, sine = (f"cos(k {unknown})", f"sin(k {unknown})")
        body += [
            "It is a trigonometric polynomial of degree 8, a polynomial of degree 16 in the tangent of the half angle."
            " Seventeen values of the determinant give its coefficients:",
            Formula(
                (f"f({unknown})", f"a_0 + sum of a_k {cosine} + b_k {sine}, k = 1..8"),
                (
                    f"f({name})",
                    rf"a_{{0}} + \sum_{{k=1}}^{{8}} \bigl( a_{{k}} \cos k {name} + b_{{k}} \sin k {name} \bigr)",
                ),
            ),
            "Its real roots are isolated on eight arcs of the circle by Descartes' rule of signs; where two are near"
            " each other the determinant is sampled anew about them.",
        ]
        return Stage((unknown,), f"the root of a polynomial of degree {self.plan.maximum}", tuple(body))

    def _null_vector(self) -> Stage:
        x, y = self._variable(self._x), self._variable(self._y)
        if self._kind(self._x) == "P":
            first = Formula((x, "X"), (self.name(x), "X"))
        else:
            first = Formula((x, "2 arctan(X)"), (self.name(x), r"2 \arctan X"))
        if self._kind(self._y) == "P":
            second = Formula((y, "W_1/W_3"), (self.name(y), r"W_{1}/W_{3}"))
        else:
            second = Formula(
                (y, "Atan2(W_1/W_3, W_2/W_3)"), (self.name(y), r"\operatorname{Atan2}(W_{1}/W_{3},\, W_{2}/W_{3})")
            )
        many = (
            " Two null vectors hold two solutions: {N_1 g = X N_2 g} for their parts {X^2 W} and {X W}."
            if self.cut.bordered
            else ""
        )
        return Stage(
            (x, y),
            "from the null vector",
            (f"The null vector of {{M}} at a root holds {{X}} and {{W}}.{many}", first, second),
        )

    def _others(self) -> Stage:
        formulas = []
        for k, places in ((1, (3, 6)), (0, (7, 8))):
            variable = self._variable(k)
            if self._kind(k) == "P":
                formulas.append(Formula((variable, f"nu_{places[0]}"), (self.name(variable), rf"\nu_{{{places[0]}}}")))
                continue
            text = f"Atan2(nu_{places[0]}, nu_{places[1]})"
            tex = rf"\operatorname{{Atan2}}(\nu_{{{places[0]}}},\, \nu_{{{places[1]}}})"
            formulas.append(Formula((variable, text), (self.name(variable), tex)))
        joint, link = self._factor(self.cut, 5)
        rest = " ".join(part for k in range(5) for part in self._factor(self.cut, k))
        formulas.append(
            Formula(
                (joint, f"({rest})^-1 {_inverse(link)}"),
                (_tex_product(joint), rf"\bigl({_tex_product(rest)}\bigr)^{{-1}} {_tex_product(_inverse(link))}"),
            )
        )
        return Stage(
            (self._variable(1), self._variable(0), self._variable(5)),
            "from what is known",
            ("{R nu = P_1 mu} gives {nu}, the loop the joint that was dropped:", *formulas),
        )

    def _polish(self) -> Stage:
        body = [
            "Newton's method with the Jacobian brings every solution onto the pose. What stays off it by more than"
            " {1e-10} of the arm's length is none; what comes twice is returned once."
        ]
        if len(self.cuts) > 1:
            other = self.cuts[1]
            way = "backward" if other.backward else "forward"
            unknown = _inline(self.variables[other.suppressed - 1])
            body.append(
                "Where a root has no solution of its own, or several have the same, the loop is opened a second time,"
                f" behind joint {other.dropped} and {way}, with {unknown} as the unknown of the polynomial; where that"
                " does not settle it, at a pose beside this one, from which Newton's method leads back."
            )
        body.append(
            f"Solutions are sorted by {_inline(self.variables[0])}, then {_inline(self.variables[1])} and so on."
        )
        return Stage((), "polished, sorted", tuple(body))


class _TwoSlides(_General):
    """The words of a plan for two sliding joints: the orientation is a matter of four angles."""

    def stages(self) -> Iterator[Stage]:
        """All of them."""
        yield self._loop()
        yield self._orientation()
        yield self._plane()
        yield self._rest()
        yield self._polish()

    @property
    def _turning(self) -> list[str]:
        """The four joints that turn, the suppressed one first."""
        order = [self.cut.order[k % 6] for k in range(2, 8)]
        return [self.variables[number - 1] for number in order if self.plan.kinds[number - 1] == "R"]

    @property
    def _slides(self) -> list[str]:
        order = [self.cut.order[k % 6] for k in range(2, 8)]
        return [self.variables[number - 1] for number in order if self.plan.kinds[number - 1] == "P"]

    def _orientation(self) -> Stage:
        first, second, third, fourth = self._turning
        names = ", ".join(map(_inline, (first, second, third, fourth)))
        return Stage(
            (third, second, fourth),
            f"from the orientation, for a value of {first}",
            (
                f"A slide turns nothing: the orientation of the loop is a matter of {names}, of which {{Rk}} are the"
                " turns and {Ak} the constant rotations between them:",
                Formula(
                    ("R1 A1 R2 A2 R3 A3 R4 A4", "I"),
                    (r"R_{1} A_{1} R_{2} A_{2} R_{3} A_{3} R_{4} A_{4}", "I"),
                ),
                f"With {{u = A1^T R1^T A4^T z}} the entry {{zz}} of {{A2 R3 A3}} gives two values of {_inline(third)}:",
                Formula(
                    ("a cos t + b sin t", "u_z - (A2)_zz (A3)_zz"),
                    (r"a \cos t + b \sin t", r"u_{z} - (A_{2})_{zz} (A_{3})_{zz}"),
                ),
                Formula(
                    ("a", "(A2)_zx (A3)_xz + (A2)_zy (A3)_yz,  b = (A2)_zy (A3)_xz - (A2)_zx (A3)_yz"),
                    (
                        "a",
                        r"(A_{2})_{zx} (A_{3})_{xz} + (A_{2})_{zy} (A_{3})_{yz} , \quad"
                        r" b = (A_{2})_{zy} (A_{3})_{xz} - (A_{2})_{zx} (A_{3})_{yz}",
                    ),
                ),
                "Then {R2} turns {A2 R3 A3 z} into {u}, and {R4} is what is left.",
            ),
        )

    def _plane(self) -> Stage:
        unknown, slides = self._turning[0], " and ".join(map(_inline, self._slides))
        name = self.name(unknown)
        return Stage(
            (unknown,),
            "the root of a polynomial of degree 8",
            (
                f"Going round the loop adds up to {{r}} and to {slides} times their directions {{k1}} and {{k2}}. It"
                " closes if the three vectors lie in one plane; with {rho^2 = 1 - u_z^2} and both roots {+} and {-}:",
                Formula(
                    (f"f({unknown})", "rho^2 det[k1 k2 r]_+ det[k1 k2 r]_- = 0"),
                    (f"f({name})", r"\rho^{2} \det[k_{1}\, k_{2}\, r]_{+} \det[k_{1}\, k_{2}\, r]_{-} = 0"),
                ),
                "It is a trigonometric polynomial of degree 4, so there are at most eight solutions. Its coefficients"
                " follow from samples, its real roots are isolated on eight arcs of the circle by Descartes' rule.",
            ),
        )

    def _rest(self) -> Stage:
        one, two = self._slides
        return Stage(
            (one, two),
            "by least squares",
            (
                Formula(
                    (f"{one} k1 + {two} k2", "-r"),
                    (f"{self.name(one)} k_{{1}} + {self.name(two)} k_{{2}}", "-r"),
                ),
            ),
        )


def _inline(text: str) -> str:
    """Mathematics inside a sentence."""
    return f"{{{text}}}"


def _inverse(factor: str) -> str:
    return factor.removesuffix("^-1") if factor.endswith("^-1") else f"{factor}^-1"


def _tex_product(text: str) -> str:
    """``M4 L4 G^-1`` for LaTeX."""
    factors = []
    for factor in text.split():
        name = factor.removesuffix("^-1")
        digits = name.lstrip("MLGBT")
        letter = name[: len(name) - len(digits)]
        factors.append(letter + (f"_{{{digits}}}" if digits else "") + ("^{-1}" if factor.endswith("^-1") else ""))
    return " ".join(factors)
