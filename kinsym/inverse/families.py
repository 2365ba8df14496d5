"""Families of solutions: where a joint is free, what follows it and what stays constant.

At a singular posture one combination of the joints moves nothing: the kernel of J. If that motion keeps the
condition for the posture to be singular, it can go on, and the pose has a whole curve of solutions; otherwise two
solutions meet there. Along the curve the kernel tells what is constant: theta4 + theta6 if the entries of joints 4 and
6 are always opposite. All of it is read from random postures modulo the prime; which joint the curve is named by is
read from the plan, the one whose step is degenerate there.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product

from kinsym.algebra.field import PRIME
from kinsym.algebra.linear import kernel
from kinsym.algebra.residues import residue_of
from kinsym.algebra.tree import ZERO, Definition, Num, Pow, Prod, Sum, Sym, Tree, add, mul, negated, negative, symbols
from kinsym.inverse.plan import Plan, Step, Window
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.singular import SingularSet
from kinsym.kinematics.singular.conditions import POSTURES, Condition
from kinsym.kinematics.singular.given import inputs
from kinsym.kinematics.singular.posture import Posture
from kinsym.kinematics.singular.zeros import Zero, postures

Relation = tuple[Tree, str, Tree]


@dataclass(frozen=True, kw_only=True)
class Family:
    """Solutions that one free joint tells apart.

    conditions    what must hold, left side, sign, right side: ``theta5 = 0``.
    free          the joint, or sum of joints, that can be chosen: it takes its reference value.
    constant      what does not change along the family: sums and single joints, shortest first.
    follows       the joints that change with the free one.
    folded        the family needs two links of equal length, folded onto each other.

    Where the plan provides for a family that no single condition of the singular set leads to, ``constant`` and
    ``follows`` are empty.
    """

    conditions: tuple[Relation, ...]
    free: str
    constant: tuple[Tree, ...] = ()
    follows: tuple[str, ...] = ()
    folded: bool = False


Motion = tuple[int, ...]
"""How fast each joint moves, modulo the prime."""

#: An expression with more names in it than this is told by its own name, such as mu5.
LONGEST_SQUARE = 12
#: Sums of at most so many joints are tried as constants.
LONGEST_SUM = 4


def families(chain: Chain, singular: SingularSet, plan: Plan) -> tuple[Family, ...]:
    """The families of an arm's inverse kinematics: those of its singular set, then what else the plan provides for."""
    found: list[Family] = []
    matched: set[str] = set()
    for condition in singular.conditions:
        for zero in condition.zeros:
            at = postures(chain, zero, POSTURES)
            motions = [motion for posture in at if (motion := _motion(chain, singular, zero, posture))]
            if not at or len(motions) < len(at):
                continue
            steps = [step for step in plan.steps if all(_degenerate(plan, step, posture) for posture in at)]
            matched |= {step.unknown for step in steps}
            family = _family(chain, plan, _relations(condition, zero), motions, steps)
            if family not in found:
                found.append(family)
    left = [step for step in plan.steps if step.unknown not in matched]
    provided = (_provided_for(chain, step) for step in left)
    return (*found, *(family for family in provided if family is not None))


def _motion(chain: Chain, singular: SingularSet, zero: Zero, posture: Posture) -> Motion | None:
    """The motion that leaves the end effector alone, if it is the only one and stays on the set."""
    basis = kernel(posture.jacobian(singular.task))
    if len(basis) != 1:
        return None
    speeds = dict(zip((joint.variable for joint in chain.joints), basis[0], strict=True))
    for part in zero:
        change = 0
        for name in chain.ring.used(part.poly):
            slope = chain.ring.evaluate(part.poly.diff(chain.ring[name]), posture.values)
            change += slope * _speed(chain, name, speeds, posture)
        if change % PRIME:
            return None
    return tuple(basis[0])


def _speed(chain: Chain, name: str, speeds: dict[str, int], posture: Posture) -> int:
    """How fast a generator changes."""
    for angle in chain.angles.values():
        turn = sum(sign * speeds[variable] for variable, sign in angle.terms)
        if name == angle.cosine:
            return -posture.values[angle.sine] * turn
        if name == angle.sine:
            return posture.values[angle.cosine] * turn
    return speeds.get(name, 0)


def _degenerate(plan: Plan, step: Step, posture: Posture) -> bool:
    """Whether a step leaves its unknown free at a posture: every square of its condition is zero."""
    if step.degenerate is None:
        return False
    values = values_at(plan, step, posture)
    trees = [*_squares(step.degenerate[0])]
    trees += [step.inputs[name] for name in ("a_alt", "b_alt") if name in step.inputs]
    return all(residue_of(tree, values) == 0 for tree in trees)


def values_at(plan: Plan, step: Step, posture: Posture) -> dict[str, int]:
    """What a step of the plan reads, modulo the prime, where the arm is in a posture; without what is no polynomial."""
    values = dict(posture.values)
    for column, vector in zip("uvwp", (*zip(*posture.turned, strict=True), posture.end), strict=True):
        values |= {f"{column}_{row}": entry for row, entry in zip("xyz", vector, strict=True)}
    for item in plan.items:
        for definition in item.coefficients if isinstance(item, Step) else _definitions(item):
            value = residue_of(definition.value, values)
            if value is not None:
                values[definition.name] = value
        if item is step:
            break
    return values


def _definitions(item: Definition | Window) -> tuple[Definition, ...]:
    """What an item of the plan gives a name to."""
    return (item,) if isinstance(item, Definition) else item.definitions


def _squares(tree: Tree) -> Iterator[Tree]:
    """The bases of a sum of squares; another expression is its own."""
    for term in tree.terms if isinstance(tree, Sum) else (tree,):
        yield term.base if isinstance(term, Pow) else term


def _relations(condition: Condition, zero: Zero) -> tuple[Relation, ...]:
    """What must hold: a joint's value where there is one."""
    return tuple(part.relation or (value, "=", ZERO) for part, value in zip(zero, condition.values, strict=True))


def _family(
    chain: Chain, plan: Plan, relations: tuple[Relation, ...], motions: list[Motion], steps: list[Step]
) -> Family:
    variables = [joint.variable for joint in chain.joints]
    moving = [k for k, speeds in enumerate(zip(*motions, strict=True)) if any(speeds)]
    turning = [k for k in moving if chain.joints[k].kind == "R"]
    fixed = {left.name for left, _, _ in relations if isinstance(left, Sym)}
    still = [name for k, name in enumerate(variables) if k not in moving and name not in fixed]
    free = steps[0].unknown if steps else variables[moving[0]]
    sums = tuple(_written(chain, plan, variables, combination) for combination in _constant_sums(turning, motions))
    return Family(
        conditions=relations,
        free=free,
        constant=(*sums, *map(Sym, still)),
        follows=tuple(variables[k] for k in moving if variables[k] != free),
    )


def _constant_sums(turning: list[int], motions: list[Motion]) -> Iterator[dict[int, int]]:
    """The sums and differences of moving joints that do not change, short ones first, each with a joint of its own."""
    covered: set[int] = set()
    for size in range(2, LONGEST_SUM + 1):
        for joints in combinations(turning, size):
            for signs in product((1, -1), repeat=size - 1):
                signed = dict(zip(joints, (1, *signs), strict=True))
                constant = not any(sum(sign * m[k] for k, sign in signed.items()) % PRIME for m in motions)
                if constant and not set(joints) <= covered:
                    covered |= set(joints)
                    yield signed


def _written(chain: Chain, plan: Plan, variables: list[str], signed: dict[int, int]) -> Tree:
    """A sum of joints, those in it that the plan solves for as a sum by their name."""
    left = {variables[k]: sign for k, sign in signed.items()}
    unknowns = {step.unknown for step in plan.steps}
    named = dict(left)
    for angle in chain.angles.values():
        if len(angle.terms) > 1 and angle.name in unknowns:
            for sign in (1, -1):
                if all(left.get(name) == sign * own for name, own in angle.terms):
                    own_names = dict(angle.terms)
                    named = {angle.name: sign, **{name: s for name, s in named.items() if name not in own_names}}
    return add(*(mul(Num(Fraction(sign)), Sym(name)) for name, sign in sorted(named.items(), key=lambda one: -one[1])))


def _provided_for(chain: Chain, step: Step) -> Family | None:
    """A family that the plan provides for although no singular condition of the table as it stands leads to it.

    None where one of the squares that have to vanish is a length of the table, such as 2*d3*d5.
    """
    if step.degenerate is None:
        return None
    given = inputs(chain)
    fixed = {name for name, _ in chain.constants.formulas() if name not in given} | set(chain.robot.parameters)
    named = {item.name: item.value for item in step.coefficients}
    bases = list(_squares(step.degenerate[0]))
    values = [named.get(base.name, base) if isinstance(base, Sym) else base for base in bases]
    if any(set(symbols(value)) <= fixed for value in values):
        return None
    relations: tuple[Relation, ...] = (step.degenerate,)
    if values != bases and all(len(list(symbols(value))) <= LONGEST_SQUARE for value in values):
        relations = tuple((_bare(value, fixed), "=", ZERO) for value in values)
    return Family(conditions=relations, free=step.unknown, folded=step.rule == "direction")


def _bare(tree: Tree, fixed: set[str]) -> Tree:
    """An expression that has to vanish, without factors that never do and without a leading minus sign."""
    if isinstance(tree, Prod):
        return mul(*(factor for factor in tree.factors if not set(symbols(factor)) <= fixed))
    first = tree.terms[0] if isinstance(tree, Sum) else tree
    return negated(tree) if negative(first) else tree
