"""Quantities that differ between the roots of a step in their sign alone.

The roots of a homogeneous equation lie half a turn apart, c and s change their signs; those of a triangle are mirror
images, w changes its sign. What follows from there by products and by sums of terms that change alike keeps its
size, in floating point to the last bit, so that an angle of the second root follows from that of the first by
half a turn or a change of sign.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from kinsym.algebra.tree import Call, Pow, Prod, Quot, Sum, Sym, Tree
from kinsym.emit.schedule import Assign, Note, Statement
from kinsym.emit.source.kernels import KERNELS

#: The outputs of a rule that change their sign between its two roots, by their place.
_OPPOSITE = {"homogeneous": (0, 1), "homogeneous2": (0, 1), "triangle": (1,)}

#: 1 for what is the same at both roots, -1 for what changes its sign, None for what does neither.
Sign = int | None


def signs(statements: Iterable[Statement], level: int) -> dict[str, Sign]:
    """How every name changes with the root of the step that opens a level; names before it are left out."""
    found: dict[str, Sign] = {}
    for statement in statements:
        if isinstance(statement, Note):
            continue
        if isinstance(statement, Assign):
            if statement.level >= level:
                found[statement.name] = sign(statement.value, found)
            continue
        step = statement.step
        opened = statement.level + (step.branches > 1)
        kernel = KERNELS[step.rule]
        inputs = [sign(step.inputs[name], found) for name in kernel.inputs]
        if statement.level + 1 == level and step.branches > 1:
            opposite = _OPPOSITE.get(step.rule)
            for place, name in enumerate(step.outputs):
                found[name] = None if opposite is None else -1 if place in opposite else 1
        elif opened >= level:
            same = 1 if all(item == 1 for item in inputs) else None
            found |= dict(zip(step.outputs, inputs if kernel.plain else [same] * len(step.outputs), strict=True))
    return found


def sign(tree: Tree, names: Mapping[str, Sign]) -> Sign:
    """How an expression changes if the names in it change so; a name that is not told of stays.

    >>> from kinsym.algebra.tree import Sym, add, mul
    >>> x, y = Sym("x"), Sym("y")
    >>> sign(mul(x, y), {"x": -1, "y": -1}), sign(add(x, y), {"x": -1, "y": -1}), sign(add(x, y), {"x": -1})
    (1, -1, None)
    """
    match tree:
        case Sym(name):
            return names.get(name, 1)
        case Sum(terms):
            first, *others = [sign(term, names) for term in terms]
            return first if all(item == first for item in others) else None
        case Prod(factors):
            return _product(sign(factor, names) for factor in factors)
        case Quot(numerator, denominator):
            return _product((sign(numerator, names), sign(denominator, names)))
        case Pow(base, exponent):
            return _product([sign(base, names)] * exponent)
        case Call(function, arguments):
            inside = [sign(argument, names) for argument in arguments]
            if function in ("abs", "cos", "hypot") and None not in inside:
                return 1
            return inside[0] if function == "sin" else 1 if all(item == 1 for item in inside) else None
        case _:
            return 1


def _product(items: Iterable[Sign]) -> Sign:
    result = 1
    for item in items:
        if item is None:
            return None
        result *= item
    return result
