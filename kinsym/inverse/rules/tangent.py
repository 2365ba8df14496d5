"""A quadratic equation of a length whose leading coefficient can vanish: a root may be at infinity.

With d = size tan(phi/2) the equation a2 d^2 + 2 a1 d + a0 = 0 is linear in the cosine and sine of phi,

    (a0 - a2 size^2) c + 2 a1 size s = -(a0 + a2 size^2),

and keeps its digits where a2 is small. A root at infinity is phi = pi.
"""

from __future__ import annotations

from kinsym.algebra.nested import number
from kinsym.algebra.tree import (
    ONE,
    Call,
    Definition,
    PlusMinus,
    Pow,
    Quot,
    Sym,
    Tree,
    add,
    mul,
    opposite,
    sub,
    sum_of_squares,
)
from kinsym.inverse.plan import Equation, Step
from kinsym.inverse.rules.base import SIZE, Names, tolerance


def length_of(names: Names, variable: str, tangent: tuple[str, Tree, Tree], equations: tuple[Equation, ...]) -> Step:
    """``d = size tan(phi/2)`` from the name, the cosine and the sine of phi."""
    phi, cosine, sine = tangent
    value = Quot(mul(SIZE, sine), add(ONE, cosine))
    return Step(
        number=names.step(),
        unknown=variable,
        rule="length",
        equations=equations,
        coefficients=(),
        inputs={"d": value},
        outputs=(variable,),
        branches=1,
        reference=((variable, 1),),
        solution=((variable, value),),
        condition=None,
        degenerate=None,
        why=f"the length that belongs to {phi}",
    )


def new_tangent(names: Names) -> tuple[str, Sym, Sym]:
    """Names for phi, its cosine and its sine."""
    return names.fresh("phi"), Sym(names.fresh("cosphi")), Sym(names.fresh("sinphi"))


def by_tangent(
    names: Names, variable: str, parts: tuple[Tree, Tree, Tree], equations: tuple[Equation, ...], why: str
) -> tuple[Step, Step]:
    """The two steps for ``a2 d^2 + 2 a1 d + a0 = 0`` with ``parts = (a2, a1, a0)``, in the unit of length squared."""
    definitions: list[Definition] = []
    a2, a1, a0 = (names.short("kappa", part, definitions) for part in parts)
    far = mul(a2, Pow(SIZE, 2))
    a = names.short("kappa", sub(a0, far), definitions)
    b = names.short("kappa", mul(number(2), a1, SIZE), definitions)
    e = names.short("kappa", opposite(add(a0, far)), definitions)
    phi, cosine, sine = new_tangent(names)
    radius = sum_of_squares(a, b)
    root = Call("sqrt", (sub(radius, sum_of_squares(e)),))
    first = Step(
        number=names.step(),
        unknown=phi,
        rule="linear",
        equations=equations,
        coefficients=tuple(definitions),
        inputs={"a": a, "b": b, "e": e, "t": tolerance(2)},
        outputs=(cosine.name, sine.name),
        branches=2,
        reference=(),
        solution=((phi, PlusMinus(Call("atan2", (b, a)), Call("atan2", (root, e)))),),
        condition=(radius, ">=", sum_of_squares(e)),
        degenerate=None,
        why=f"{why}, quadratic in {variable} = size tan({phi}/2)",
    )
    return first, length_of(names, variable, (phi, cosine, sine), equations)
