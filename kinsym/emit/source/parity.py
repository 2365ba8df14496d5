"""What a quantity becomes where the root of a branch changes its sign.

The two roots of a step often differ by a sign: (c, s) and (-c, -s) of a homogeneous equation, w and -w of a
triangle. What is computed from them is then the same, or the opposite, and an angle turns into its opposite, its
supplement or the angle half a turn away: the second solution of a wrist costs three additions (Paul 1981, section 3.3:
theta4 + pi, -theta5, theta6 + pi).
"""

from __future__ import annotations

from collections.abc import Mapping
from math import prod

from kinsym.algebra.tree import ZERO, Call, Num, Pi, Pow, Prod, Quot, Sum, Sym, Tree, children, negated
from kinsym.inverse.plan import Step

#: A quantity that stays and one that changes its sign; None stands for neither.
EVEN, ODD = 1, -1

Parity = int | None

#: What becomes of an angle other than the same.
TURNS = ("opposite", "half_turn", "supplement")
_ANGLES = {(EVEN, EVEN): "same", (ODD, EVEN): "opposite", (ODD, ODD): "half_turn", (EVEN, ODD): "supplement"}


def parity(tree: Tree, known: Mapping[str, Parity]) -> Parity:
    """The parity of an expression; names that are not ``known`` are even.

    >>> parity(Prod((Sym("c4"), Sym("s4"))), {"c4": ODD, "s4": ODD})
    1
    >>> parity(Sum((Sym("c4"), Sym("x"))), {"c4": ODD}) is None
    True
    """
    match tree:
        case Num() | Pi():
            return EVEN
        case Sym(name):
            return known.get(name, EVEN)
        case Sum(terms):
            found = {parity(term, known) for term in terms}
            return found.pop() if len(found) == 1 else None
        case Prod() | Quot():
            return _product(*(parity(part, known) for part in children(tree)))
        case Pow(base, exponent):
            return _product(*[parity(base, known)] * exponent)
        case Call("sin", (argument,)):
            return parity(argument, known)
        case Call("abs" | "cos", (argument,)):
            return EVEN if parity(argument, known) else None
        case Call(_, arguments):
            return EVEN if all(parity(argument, known) == EVEN for argument in arguments) else None
    return None


def turn_of(value: Tree, known: Mapping[str, Parity]) -> str | None:
    """What becomes of an angle: "same", one of :data:`TURNS`, or None if that is not known.

    >>> turn_of(Call("atan2", (Sym("s4"), Sym("c4"))), {"s4": ODD, "c4": ODD})
    'half_turn'
    """
    match value:
        case Call("atan2", (sine, cosine)):
            signs = parity(sine, known), parity(cosine, known)
            return None if None in signs else _ANGLES[signs]
    return None


def _product(*parities: Parity) -> Parity:
    signs = [sign for sign in parities if sign is not None]
    return prod(signs) if len(signs) == len(parities) else None


def of_roots(step: Step) -> dict[str, Parity]:
    """The parities of what a step with two roots leads to, from its first root to its second."""
    zero = {name for name, value in step.inputs.items() if value == ZERO}
    signs: tuple[Parity, ...]
    match step.rule:
        case "homogeneous" | "homogeneous2":
            signs = (ODD, ODD)
        case "linear":
            signs = (EVEN, ODD) if "b" in zero else (ODD, EVEN) if "a" in zero else (ODD, ODD) if "e" in zero else ()
        case "triangle":
            signs = (EVEN, ODD, EVEN)
        case "quadratic":
            signs = (ODD,) if "b" in zero else ()
        case _:
            signs = ()
    return dict(zip(step.outputs, signs or [None] * len(step.outputs), strict=True))


def of_outputs(step: Step, known: Mapping[str, Parity]) -> dict[str, Parity]:
    """The parities of the outputs of a step with one root."""
    given = {name: parity(value, known) for name, value in step.inputs.items()}
    signs: tuple[Parity, ...]
    match step.rule:
        case "quotient":
            signs = (_product(given["x"], given["d"]), _product(given["y"], given["d"]))
        case "quotient_length":
            signs = (_product(given["n"], given["d"]),)
        case "direction":
            x, y, along, across = (given[name] for name in ("x", "y", "along", "across"))
            cosine, sine = {_product(x, along), _product(y, across)}, {_product(y, along), _product(x, across)}
            signs = tuple(found.pop() if len(found) == 1 else None for found in (cosine, sine))
        case _:
            signs = (None,) * len(step.outputs)
    return dict(zip(step.outputs, signs, strict=True))


def substituted(tree: Tree, values: Mapping[str, Tree]) -> Tree:
    """The expression with names replaced.

    >>> substituted(Quot(Sym("a"), Sym("b")), {"b": Sym("d")})
    Quot(numerator=Sym(name='a'), denominator=Sym(name='d'))
    """
    match tree:
        case Sym(name):
            return values.get(name, tree)
        case Sum(terms):
            return Sum(tuple(substituted(term, values) for term in terms))
        case Prod(factors):
            return Prod(tuple(substituted(factor, values) for factor in factors))
        case Pow(base, exponent):
            return Pow(substituted(base, values), exponent)
        case Quot(numerator, denominator):
            return Quot(substituted(numerator, values), substituted(denominator, values))
        case Call(function, arguments):
            return Call(function, tuple(substituted(argument, values) for argument in arguments))
    return tree
