"""Random arms that have a closed form, as strategies that shrink to few joints, right angles and lengths of zero."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

from hypothesis import assume
from hypothesis import strategies as st

from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.tasks import fitting_task, rank, told
from tests.laws.tables import ZERO, Cell, Frame, Row, Table

Draw = Callable[[st.SearchStrategy[Any]], Any]


def angle(text: str) -> Cell:
    """A multiple of pi."""
    return Cell(Fraction(text), "pi")


RIGHT = st.sampled_from([angle("1/2"), angle("-1/2")])
STRAIGHT = st.sampled_from([ZERO, angle("1")])
SKEW = st.sampled_from([angle("1/4"), angle("1/6"), angle("-1/3"), Cell(Fraction("0.7")), Cell(Fraction(1), "alpha")])
OFFSETS = st.sampled_from(
    [ZERO, ZERO, ZERO, angle("1/2"), angle("-1/2"), angle("1"), angle("1/6"), Cell(Fraction("-0.3"))]
)
NUMBERS = st.sampled_from([Cell(Fraction(text)) for text in ("0.4", "0.25", "-0.3", "0.612")])


def link(name: str) -> st.SearchStrategy[Cell]:
    """A length that is not zero: a parameter of its own, one that other rows may have too, a number."""
    return st.one_of(st.just(Cell(Fraction(1), name)), st.just(Cell(Fraction(1), "b")), NUMBERS)


def twist() -> st.SearchStrategy[Cell]:
    """A twist between axes that are not parallel."""
    return st.one_of(RIGHT, RIGHT, SKEW)


@st.composite
def rows(draw: Draw, kinds: str) -> list[Row]:
    """Joints with any twists and lengths."""
    return [
        Row(
            kind,
            alpha=draw(st.one_of(twist(), STRAIGHT)),
            a=draw(st.one_of(st.just(ZERO), link(f"a{i}"))),
            d=draw(st.one_of(st.just(ZERO), link(f"l{i}"))) if kind == "R" else ZERO,
            theta=draw(OFFSETS),
        )
        for i, kind in enumerate(kinds, start=1)
    ]


@st.composite
def small(draw: Draw) -> Table:
    """Two or three joints of any kind, for the task that fits them or for a whole pose."""
    kinds = draw(st.sampled_from(["RR", "RP", "PR", "PP", "RRR", "RRP", "RPR", "PRR", "RPP", "PRP", "PPR", "PPP"]))
    return Table(tuple(draw(rows(kinds))), task=draw(st.sampled_from(["", "", "pose"])))


@st.composite
def turning(draw: Draw) -> Table:
    """Three revolute joints that turn a frame."""
    return Table(tuple(draw(rows("RRR"))), task="orientation")


@st.composite
def parallel(draw: Draw) -> Table:
    """Three or four joints with parallel axes, one perhaps sliding along them."""
    kinds = draw(st.sampled_from(["RRR", "RRRP", "RRPR", "RPRR", "PRRR"]))
    return Table(
        tuple(
            replace(row, alpha=draw(STRAIGHT) if i < len(kinds) else ZERO, a=draw(link(f"a{i}")))
            for i, row in enumerate(draw(rows(kinds)), start=1)
        )
    )


@st.composite
def wrist(draw: Draw) -> Table:
    """Six joints, three consecutive of them revolute with axes that meet in a point."""
    first = draw(st.sampled_from([4, 4, 1, 2, 3]))
    others = draw(st.sampled_from(["RRR", "RRR", "RRP", "RPR", "PRR", "PPP"]))
    table = draw(rows(others[: first - 1] + "RRR" + others[first - 1 :]))
    table[first - 1] = replace(table[first - 1], a=ZERO, alpha=draw(twist()))
    table[first] = replace(table[first], a=ZERO, d=ZERO, alpha=draw(twist()))
    return Table(tuple(table))


@st.composite
def three_parallel(draw: Draw) -> Table:
    """Six revolute joints, three consecutive of them with parallel axes."""
    first = draw(st.sampled_from([2, 1, 3, 4]))
    table = draw(rows("RRRRRR"))
    for i in (first - 1, first):
        table[i] = replace(table[i], alpha=draw(STRAIGHT), a=draw(link(f"a{i + 1}")))
    return Table(tuple(table))


@st.composite
def five(draw: Draw) -> Table:
    """Five joints for a position and the direction of the tool: an elbow, then two axes that meet."""
    table = draw(rows("RRRRR"))
    table[1] = replace(table[1], alpha=draw(STRAIGHT), a=draw(link("a2")))
    table[3] = replace(table[3], a=ZERO, alpha=draw(RIGHT))
    table[4] = replace(table[4], a=ZERO, d=ZERO, alpha=ZERO)
    return Table(tuple(table), task="position_axis")


def usable(table: Table) -> bool:
    """Whether no joint repeats others for the task."""
    robot = table.robot()
    chain = build_chain(robot)
    return rank(told(chain, robot.task or fitting_task(chain, chain))) == len(chain.joints)


@st.composite
def tables(draw: Draw) -> Table:
    """An arm of any of these classes, in Paul's convention, without base and tool."""
    table: Table = draw(st.one_of(small(), turning(), parallel(), wrist(), three_parallel(), five()))
    assume(usable(table))
    return table


def frames() -> st.SearchStrategy[Frame]:
    """A base or a tool."""
    lengths = st.one_of(st.just(ZERO), NUMBERS)
    turns = st.one_of(st.just(ZERO), RIGHT, SKEW.filter(lambda cell: cell.unit != "alpha"))
    return st.builds(Frame, st.tuples(lengths, lengths, lengths), st.tuples(turns, turns, turns))
