"""Numbers for trees.

The checks read the same trees that the printers print, but never the printed text: a tree becomes a chain of
closures over an :class:`Arithmetic`, either 50 digits of mpmath (the exact side of every comparison) or arrays of
float64 (fast searches over many joint vectors).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np
from mpmath.ctx_mp import MPContext

from kinsym.algebra.tree import Call, Num, Pi, Pow, Prod, Quot, Sum, Sym, Tree
from kinsym.inverse.plan import Definition

DIGITS = 50

Value = Any
Environment = dict[str, Value]
Compiled = Callable[[Mapping[str, Value]], Value]


@dataclass(frozen=True)
class Arithmetic:
    """The numbers that trees are evaluated in."""

    name: str
    number: Callable[[Fraction], Value]
    pi: Value
    functions: Mapping[str, Callable[..., Value]]


@lru_cache(maxsize=1)
def exact() -> tuple[Any, Arithmetic]:
    """A private mpmath context of 50 digits and the arithmetic over it."""
    ctx = MPContext()
    ctx.dps = DIGITS
    pi = +ctx.pi

    def wrap(x: Value) -> Value:
        """``x`` plus the multiple of 2 pi that brings it into (-pi, pi]."""
        return x - 2 * pi * ctx.ceil((x - pi) / (2 * pi))

    functions = {
        "sqrt": ctx.sqrt,
        "sin": ctx.sin,
        "cos": ctx.cos,
        "abs": abs,
        "sign": lambda x: -1 if x < 0 else 1,
        "atan2": ctx.atan2,
        "hypot": lambda x, y: ctx.sqrt(x * x + y * y),
        "wrap": wrap,
    }
    return ctx, Arithmetic("mpmath", lambda q: ctx.mpf(q.numerator) / q.denominator, pi, functions)


def floating() -> Arithmetic:
    """The arithmetic of float64 arrays."""
    functions: dict[str, Callable[..., Value]] = {
        "sqrt": np.sqrt,
        "sin": np.sin,
        "cos": np.cos,
        "abs": np.abs,
        "sign": lambda x: np.where(x < 0, -1.0, 1.0),
        "atan2": np.arctan2,
        "hypot": np.hypot,
        "wrap": lambda x: x - 2 * np.pi * np.ceil((x - np.pi) / (2 * np.pi)),
    }
    return Arithmetic("float64", float, np.pi, functions)


def compiled(tree: Tree, numbers: Arithmetic) -> Compiled:
    """A function of an environment that computes the tree."""
    match tree:
        case Num(value):
            number = numbers.number(value)
            return lambda env: number
        case Pi():
            return lambda env: numbers.pi
        case Sym(name):
            return lambda env: env[name]
        case Sum(terms):
            return _fold([compiled(term, numbers) for term in terms], lambda x, y: x + y)
        case Prod(factors):
            return _fold([compiled(factor, numbers) for factor in factors], lambda x, y: x * y)
        case Pow(base, exponent):
            inner = compiled(base, numbers)
            return lambda env: inner(env) ** exponent
        case Quot(numerator, denominator):
            top, bottom = compiled(numerator, numbers), compiled(denominator, numbers)
            return lambda env: top(env) / bottom(env)
        case Call(function, arguments):
            apply = numbers.functions[function]
            inputs = [compiled(argument, numbers) for argument in arguments]
            return lambda env: apply(*(value(env) for value in inputs))
        case _:
            raise TypeError(f"{type(tree).__name__} has no value")


def _fold(parts: list[Compiled], operation: Callable[[Value, Value], Value]) -> Compiled:
    first, *rest = parts

    def value(env: Mapping[str, Value]) -> Value:
        total = first(env)
        for part in rest:
            total = operation(total, part(env))
        return total

    return value


class Program:
    """A straight line of definitions, ready to run.

    >>> from kinsym.algebra.tree import Sym, add
    >>> total = Definition(name="x", value=add(Sym("a"), Sym("b")))
    >>> Program((total,), (Sym("x"),), floating())({"a": 1.0, "b": 2.0})
    [3.0]
    """

    def __init__(self, definitions: Iterable[Definition], outputs: Iterable[Tree], numbers: Arithmetic) -> None:
        self._definitions = [(item.name, compiled(item.value, numbers)) for item in definitions]
        self._outputs = [compiled(tree, numbers) for tree in outputs]

    def names(self, given: Mapping[str, Value]) -> Environment:
        """The names given and those defined; a definition never changes the caller's mapping."""
        env = dict(given)
        for name, value in self._definitions:
            env[name] = value(env)
        return env

    def __call__(self, given: Mapping[str, Value]) -> list[Value]:
        """The outputs for the names given."""
        env = self.names(given)
        return [output(env) for output in self._outputs]
