"""One angle as the root of a polynomial, the others by linear equations.

The numbers of equations are those of Raghavan and Roth (1990): 14 equations, of which the products of two joints take
eight away, six in the monomials of three joints, a 12 x 12 matrix, degree 16.
"""

from __future__ import annotations

from collections.abc import Iterator

from kinsym.emit.prose.general.loop import Loop, inverse, tex_product
from kinsym.emit.prose.general.stage import Formula, Stage, inline


class OneAngle(Loop):
    """The words of a plan with at most one sliding joint."""

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

    def _monomials(self, k: int) -> tuple[str, str]:
        """(s4, c4, 1) or (d3, d3^2, 1), as text and for LaTeX."""
        variable = self._variable(k)
        if self._kind(k) == "P":
            return f"({variable}, {variable}^2, 1)", f"({self.name(variable)}, {self.name(variable)}^2, 1)"
        cosine, sine = self.turns[variable]
        return f"({sine}, {cosine}, 1)", f"({self.name(sine)}, {self.name(cosine)}, 1)"

    def _sides(self) -> tuple[str, str]:
        """N2 K2 N3 K3 N4 K4, and the inverse of the rest without N5."""
        left = " ".join(part for k in (2, 3, 4) for part in self._factor(self.cut, k))
        right: list[str] = []
        for k in (1, 0):
            joint, link = self._factor(self.cut, k)
            right += [inverse(link), inverse(joint)]
        return left, " ".join([*right, inverse(self._factor(self.cut, 5)[1])])

    def _equations(self) -> Stage:
        left, right = self._sides()
        m = [self._monomials(k) for k in range(5)]
        unknown = self._variable(5)
        return Stage(
            (unknown,),
            "dropped, 14 equations",
            (
                f"A turn by {inline(unknown)} leaves the axis of joint {self.cut.dropped} where it is. So both sides"
                " of the loop do the same to this axis, and the angle is gone:",
                Formula(
                    (f"{left} psi0", f"{right} psi0"),
                    (f"{tex_product(left)} \\, \\psi_{{0}}", f"{tex_product(right)} \\, \\psi_{{0}}"),
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
                f" {inline(m[2][0])}, {inline(m[3][0])} and {inline(m[4][0])}, on the right in those of"
                f" {inline(m[1][0])} and {inline(m[0][0])}:",
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
                f" {{6 x 3}} and linear in the cosine and the sine of {inline(unknown)}:",
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
                (joint, f"({rest})^-1 {inverse(link)}"),
                (tex_product(joint), rf"\bigl({tex_product(rest)}\bigr)^{{-1}} {tex_product(inverse(link))}"),
            )
        )
        return Stage(
            (self._variable(1), self._variable(0), self._variable(5)),
            "from what is known",
            ("{R nu = P_1 mu} gives {nu}, the loop the joint that was dropped:", *formulas),
        )
