"""From the items of a finished search to a plan: sums of angles where they are used, joint values, nothing unused."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from kinsym.algebra.nested import nested, number
from kinsym.algebra.tree import Call, Definition, Num, Sym, Tree, add, mul, negated, negative, sub, symbols
from kinsym.inverse.knowledge import Knowledge
from kinsym.inverse.plan import Item, JointValue, Plan, Step, Window
from kinsym.inverse.rules.base import edge
from kinsym.inverse.state import FIXED
from kinsym.kinematics.angles import Angle
from kinsym.kinematics.chain import Chain
from kinsym.robot.model import Task

IN_A_PLANE = (Task.PLANAR, Task.SCARA)
"""Tasks whose pose must lie in the plane of the arm, which their equations do not state."""


def assemble(chain: Chain, task: Task, items: tuple[Item, ...], unread: tuple[str, ...] = ()) -> Plan:
    """The plan of a finished search; of the joints in ``unread`` nobody wants the value."""
    items, known = _with_sums(chain, items)
    values = tuple(value for value in _joint_values(chain, known) if value.variable not in unread)
    items = _used(items, {name for value in values for name in symbols(value.value)})
    maximum = 1
    for item in items:
        if isinstance(item, Step):
            maximum *= item.branches
    return Plan(
        task=task,
        items=items,
        values=values,
        maximum=maximum,
        gate=len(chain.joints) < FIXED[task] or task in IN_A_PLANE,
        size=arm_size(chain),
    )


def _with_sums(chain: Chain, items: tuple[Item, ...]) -> tuple[tuple[Item, ...], Knowledge]:
    """Put the definition of c23 and s23 before their first use."""
    by_name = {name: angle for angle in chain.angles.values() for name in (angle.cosine, angle.sine)}
    by_value = {angle.name: angle for angle in chain.angles.values()}
    known = Knowledge(chain)
    defined: set[str] = set()
    result: list[Item] = []

    def ensure(angle: Angle) -> None:
        if angle.cosine in defined:
            return
        path = known.path(angle.group, angle.low, angle.high)
        here = path[0][1]
        for _, there in path[1:]:
            first = _angle(chain, angle.group, angle.low, here)
            second = _angle(chain, angle.group, here, there)
            both = _angle(chain, angle.group, angle.low, there)
            if both.cosine not in defined:
                result.extend(_sum(chain, angle.group, (angle.low, here, there), (first, second, both)))
                defined.update((both.cosine, both.sine))
            here = there

    for item in items:
        for name in _reads(item):
            if name in by_name and name not in _writes(item):
                ensure(by_name[name])
        result.append(item)
        defined.update(_writes(item))
        if isinstance(item, Definition) and item.name in by_value:
            known = known.with_angle(edge(by_value[item.name]))
    return tuple(result), known


def _angle(chain: Chain, group: int, start: int, end: int) -> Angle:
    return chain.angles[group, min(start, end), max(start, end)]


def _sum(
    chain: Chain, group: int, nodes: tuple[int, int, int], angles: tuple[Angle, Angle, Angle]
) -> tuple[Definition, Definition]:
    """cos(a + b) and sin(a + b); the signs are those of the angles as they are named."""
    start, middle, end = nodes
    first, second, both = angles

    def sine(angle: Angle, forward: bool) -> Tree:
        sym = Sym(angle.sine)
        return sym if (angle.sign > 0) == forward else negated(sym)

    s1, s2 = sine(first, start < middle), sine(second, middle < end)
    c1, c2 = Sym(first.cosine), Sym(second.cosine)
    total = add(mul(s1, c2), mul(c1, s2))
    if (both.sign > 0) != (start < end):
        total = negated(total)
    return (
        Definition(name=both.cosine, value=sub(mul(c1, c2), mul(s1, s2))),
        Definition(name=both.sine, value=total),
    )


def _joint_values(chain: Chain, known: Knowledge) -> Iterable[JointValue]:
    node = {group.index: 0 for group in chain.groups}
    place = {position: group for group in chain.groups for position in group.joints}
    for position, joint in enumerate(chain.joints):
        if joint.kind == "P":
            yield JointValue(variable=joint.variable, value=Sym(joint.variable), wrapped=False)
            continue
        group = place[position].index
        low = node[group]
        node[group] += 1
        own = chain.angles[group, low, low + 1]
        path = known.path(group, low, low + 1)
        if len(path) == 1:
            yield JointValue(variable=joint.variable, value=Sym(own.name), wrapped=False)
            continue
        terms = []
        for start, end in path:
            angle = _angle(chain, group, start, end)
            forward = (angle.sign > 0) == (start < end)
            terms.append(mul(number(1 if forward == (own.sign > 0) else -1), Sym(angle.name)))
        terms.sort(key=lambda term: (negative(term), *symbols(term)))
        yield JointValue(variable=joint.variable, value=add(*terms), wrapped=True)


def _used(items: tuple[Item, ...], wanted: set[str]) -> tuple[Item, ...]:
    """Only the definitions that a joint value needs."""
    wanted = set(wanted)
    result: list[Item] = []
    for item in reversed(items):
        if isinstance(item, Window):
            kept: list[Definition] = []
            for definition in reversed(item.definitions):
                if definition.name in wanted:
                    kept.insert(0, definition)
                    wanted.update(symbols(definition.value))
            if kept:
                result.append(replace(item, definitions=tuple(kept)))
            continue
        if isinstance(item, Definition) and item.name not in wanted:
            continue
        if isinstance(item, Step) and item.branches == 1 and not wanted.intersection(_writes(item)):
            continue
        wanted.update(_reads(item))
        result.append(item)
    return tuple(reversed(result))


def _reads(item: Item) -> list[str]:
    if isinstance(item, Definition):
        return list(symbols(item.value))
    if isinstance(item, Window):
        return [name for definition in item.definitions for name in symbols(definition.value)]
    trees = [definition.value for definition in item.coefficients] + list(item.inputs.values())
    return [name for tree in trees for name in symbols(tree)]


def _writes(item: Item) -> tuple[str, ...]:
    if isinstance(item, Definition):
        return (item.name,)
    if isinstance(item, Window):
        return tuple(definition.name for definition in item.definitions)
    return (*(definition.name for definition in item.coefficients), *item.outputs)


def arm_size(chain: Chain) -> Tree:
    """The size of the arm: the sum of its constant lengths, and where it slides the pose's own coordinates."""
    terms = list(_lengths(chain))
    if any(joint.kind == "P" for joint in chain.joints):
        terms += [Call("abs", (Sym(f"p_{row}"),)) for row in "xyz"]
    return add(*terms) if terms else number(1)


def constant_lengths(chain: Chain) -> Tree:
    """The sum of the arm's constant lengths, 1 if it has none."""
    terms = list(_lengths(chain))
    return add(*terms) if terms else number(1)


def _lengths(chain: Chain) -> Iterator[Tree]:
    for joint in chain.joints:
        for entry in joint.after.translation:
            if entry:
                tree = nested(chain.ring, entry)
                yield tree if isinstance(tree, Num) and tree.value > 0 else Call("abs", (tree,))
