"""Conditions between exact numbers: ``l1 - l2 <= r <= l1 + l2``."""

from __future__ import annotations

import operator
from collections.abc import Callable
from fractions import Fraction

from kinsym.lecture.evaluate import Evaluator
from kinsym.lecture.notation import Relation
from kinsym.lecture.residue import Scalar, Undefined

_COMPARE: dict[str, Callable[[Fraction, Fraction], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
}


def holds(relation: Relation, evaluate: Evaluator) -> bool:
    """Whether every comparison of a chain is true.

    >>> from kinsym.lecture.notation import parse_relation
    >>> holds(parse_relation("1 < 2 <= 2"), Evaluator({}.__getitem__, exact=True))
    True
    """
    values = [_number(evaluate.scalar(member)) for member in relation.members]
    return all(
        _COMPARE[sign](left, right) for sign, left, right in zip(relation.signs, values, values[1:], strict=False)
    )


def _number(value: Scalar) -> Fraction:
    if not isinstance(value, Fraction):
        raise Undefined("a residue cannot be compared")
    return value
