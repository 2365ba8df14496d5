"""What a plan takes for granted of the table: lengths, sines and cosines of twists that must not be zero.

A plan is right for general values of the parameters. Where one of them vanishes a step may divide by it, or two axes
meet and an equation that told one unknown tells none; then another plan is the right one, that of the table with the
zero folded in. Which parameters these are is found by running the plan at a random posture modulo the prime: at
general values nothing is singular there, so whatever is with a parameter at zero is so at every pose.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Mapping, Set
from types import MappingProxyType

from kinsym.algebra.field import PRIME, inverse
from kinsym.algebra.residues import residue_of
from kinsym.algebra.tree import Call, Pow, Prod, Quot, Sum, Sym, Tree, children, symbols
from kinsym.inverse.plan import Definition, Item, Nonzero, Plan, Step, Window
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.singular.posture import posture

NOTHING: Mapping[str, str] = MappingProxyType({})

_READ = {
    "quotient": (("d",),),
    "quotient_length": (("d",),),
    "homogeneous": (("a", "b"),),
    "homogeneous2": (("a", "b", "a_alt", "b_alt"),),
    "linear": (("a", "b"),),
    "linear_pole": (("a", "b"),),
    "triangle": (("l1",), ("l2",)),
    "direction": (("along", "across"), ("x", "y")),
}
"""By rule: of each of these groups of inputs one must not be zero, or the unknown is free."""


def nonzero(chain: Chain, plan: Plan, aliases: Mapping[str, str] = NOTHING) -> tuple[Nonzero, ...]:
    """What a plan needs of the constants of its chain, lengths first.

    ``aliases`` tells names of the plan that stand for an entry of the pose.
    """
    general = set(_troubles(chain, plan, {}, aliases))
    found = {name for name, given in zeros(chain) if set(_troubles(chain, plan, given, aliases)) - general}
    conditions = conditions_of(chain, found)
    varying = _varying(chain)
    fixed = {*varying, *(name for name, formula in chain.constants.formulas() if not formula.free_symbols)}
    others: dict[Tree, None] = {}
    for tree in (tree for item in plan.items for tree in _trees(item)):
        for factor in _denominators(tree):
            names = {*symbols(factor)}
            if not isinstance(factor, Sym) and names & {*varying} and names <= fixed:
                others.setdefault(factor)
    sums = tuple(Nonzero(value=value, unit=None, parameters=_together(varying, symbols(value))) for value in others)
    return (*conditions, *sums)


def conditions_of(chain: Chain, names: Set[str]) -> tuple[Nonzero, ...]:
    """The conditions for parameters, cosines and sines by their names, in the order of the table."""
    varying = _varying(chain)
    lengths = {*chain.constants.parameters}
    return tuple(
        Nonzero(value=Sym(name), unit=1 if name in lengths else 0, parameters=varying[name])
        for name, _ in zeros(chain)
        if name in names
    )


def _varying(chain: Chain) -> dict[str, tuple[str, ...]]:
    """The parameters, and the cosines and sines that depend on some: the parameters of each."""
    result: dict[str, tuple[str, ...]] = {name: (name,) for name in chain.constants.parameters}
    parameters = set(chain.robot.parameters)
    for name, formula in chain.constants.formulas():
        used = {symbol.name for symbol in formula.free_symbols}
        if used and used <= parameters:
            result[name] = tuple(sorted(used))
    return result


def _together(varying: Mapping[str, tuple[str, ...]], names: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(parameter for name in names for parameter in varying.get(name, ())))


def zeros(chain: Chain) -> Iterator[tuple[str, dict[str, int]]]:
    """Every parameter, sine and cosine of the table that can vanish, and the values with which it does."""
    for name in chain.constants.parameters:
        yield name, {name: 0}
    varying = _varying(chain)
    for name in chain.constants.angles.values():
        if f"s{name}" not in varying:
            continue
        yield f"s{name}", {f"c{name}": 1, f"s{name}": 0}
        yield f"c{name}", {f"c{name}": 0, f"s{name}": 1}


def _troubles(
    chain: Chain, plan: Plan, given: Mapping[str, int], aliases: Mapping[str, str]
) -> Iterator[tuple[int, str]]:
    """What cannot be computed at a random posture, or leaves an unknown free: number of the item, name."""
    values = chain.sample(random.Random("nonzero"), given)
    at = posture(chain, values)
    entries = {
        f"{column}_{row}": entry
        for column, vector in zip("uvwp", (*zip(*at.turned, strict=True), at.end), strict=True)
        for row, entry in zip("xyz", vector, strict=True)
    }
    values |= entries | {name: entries[entry] for name, entry in aliases.items()}
    for number, item in enumerate(plan.items):
        for definition in _definitions(item):
            if definition.name not in values:
                try:
                    value = _value(definition.value, values)
                except ZeroDivisionError:
                    yield number, definition.name
                    continue
                if value is not None:
                    values[definition.name] = value
        if isinstance(item, Step):
            yield from ((number, name) for name in _lost(item, values))


def _lost(step: Step, values: Mapping[str, int]) -> Iterator[str]:
    """The inputs of a step with which its unknown is free, or that cannot be computed."""
    inputs: dict[str, int | None] = {}
    for name, tree in step.inputs.items():
        try:
            inputs[name] = _value(tree, values)
        except ZeroDivisionError:
            yield name
            return
    for group in _READ.get(step.rule, ()):
        if all(inputs[name] == 0 for name in group):
            yield group[0]
    if step.rule == "quartic" and not any(_eliminant(inputs)):
        yield "t"


def _eliminant(inputs: Mapping[str, int | None]) -> Iterator[int]:
    """The coefficients of c^2, c s, c, s and 1 in X^2 + Y^2 - k1^2 - k2^2, of which the polynomial is made."""
    total = [0, 0, 0, 0, 0]
    for name, sign in (("x", 1), ("y", 1), ("k", -1), ("l", -1)):
        p, q, r = (inputs[f"{name}{end}"] for end in ("c", "s", ""))
        if p is None or q is None or r is None:
            yield 1
            return
        for place, product in enumerate((p * p - q * q, 2 * p * q, 2 * p * r, 2 * q * r, q * q + r * r)):
            total[place] += sign * product
    yield from (coefficient % PRIME for coefficient in total)


def _value(tree: Tree, values: Mapping[str, int]) -> int | None:
    """The value of a tree modulo the prime, None where it is not known, which is never so of a zero.

    Raises ZeroDivisionError.
    """
    match tree:
        case Quot(above, below):
            divisor, value = _value(below, values), _value(above, values)
            if divisor == 0:
                raise ZeroDivisionError
            if value == 0 or divisor is None or value is None:
                return 0 if value == 0 else None
            return value * inverse(divisor) % PRIME
        case Sum(terms):
            parts = [_value(term, values) for term in terms]
            return None if None in parts else sum(part or 0 for part in parts) % PRIME
        case Prod(factors):
            total: int | None = 1
            for part in [_value(factor, values) for factor in factors]:
                total = 0 if 0 in (part, total) else None if part is None or total is None else part * total % PRIME
            return total
        case Pow(base, exponent):
            inner = _value(base, values)
            return None if inner is None else pow(inner, exponent, PRIME)
        case Call("sqrt" | "abs", (argument,)):
            return 0 if _value(argument, values) == 0 else None
        case _:
            return residue_of(tree, values)


def _definitions(item: Item) -> tuple[Definition, ...]:
    if isinstance(item, Step):
        return item.coefficients
    return item.definitions if isinstance(item, Window) else (item,)


def _trees(item: Item) -> Iterator[Tree]:
    yield from (definition.value for definition in _definitions(item))
    if isinstance(item, Step):
        yield from item.inputs.values()


def _denominators(tree: Tree) -> Iterator[Tree]:
    """The factors of all denominators, without powers and absolute values."""
    if isinstance(tree, Quot):
        yield from _factors(tree.denominator)
    for child in children(tree):
        yield from _denominators(child)


def _factors(tree: Tree) -> Iterator[Tree]:
    match tree:
        case Prod(factors):
            for factor in factors:
                yield from _factors(factor)
        case Pow(base, _):
            yield from _factors(base)
        case Call("abs", (argument,)):
            yield from _factors(argument)
        case _:
            yield tree
