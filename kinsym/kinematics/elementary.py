"""The elementary transforms that a Denavit-Hartenberg row is the product of (lecture, slides 12 to 15).

Craig: R_X(alpha_i-1) D_X(a_i-1) R_Z(theta_i) D_Z(d_i). Paul: D_Z(d_i) R_Z(theta_i) D_X(a_i) R_X(alpha_i). Every motion
is about or along the axes as the ones before it have left them.
"""

from __future__ import annotations

from kinsym.algebra.tree import ONE, ZERO, Call, Sym, Tree, negated
from kinsym.robot.model import Convention

Matrix = tuple[tuple[Tree, ...], ...]

FACTORS: dict[Convention, tuple[tuple[str, str], ...]] = {
    Convention.CRAIG: (("R_X", "alpha"), ("D_X", "a"), ("R_Z", "theta"), ("D_Z", "d")),
    Convention.PAUL: (("D_Z", "d"), ("R_Z", "theta"), ("D_X", "a"), ("R_X", "alpha")),
}
"""The factors of a row in order: which transform, of which cell."""

SCREWS: dict[Convention, tuple[tuple[str, str, str], ...]] = {
    Convention.CRAIG: (("Screw_X", "a", "alpha"), ("Screw_Z", "d", "theta")),
    Convention.PAUL: (("Screw_Z", "d", "theta"), ("Screw_X", "a", "alpha")),
}
"""The same in two factors: a turn about an axis and a slide along it can change places."""


def elementary(transform: str, length: str = "", angle: str = "") -> Matrix:
    """``R_X``, ``R_Z`` (of an angle), ``D_X``, ``D_Z`` (of a length) or ``Screw_X``, ``Screw_Z`` (of both) as a matrix.

    >>> elementary("D_X", length="a2")[0][3]
    Sym(name='a2')
    """
    place = "XYZ".index(transform[-1])
    rows: list[list[Tree]] = [[ONE if i == k else ZERO for k in range(4)] for i in range(4)]
    if length:
        rows[place][3] = Sym(length)
    if angle:
        before, after = (i for i in range(3) if i != place)
        cosine, sine = Call("cos", (Sym(angle),)), Call("sin", (Sym(angle),))
        rows[before][before] = rows[after][after] = cosine
        rows[before][after], rows[after][before] = negated(sine), sine
    return tuple(map(tuple, rows))
