"""Equations in which a length has been replaced hold, have no unknown too many, and take no more time than they may."""

from __future__ import annotations

import pytest

from kinsym.algebra.ring import Poly
from kinsym.inverse import substitution
from kinsym.inverse.pool import Pool, PoolEquation
from kinsym.inverse.state import State, start
from kinsym.inverse.substitution import LONGEST, ROUNDS, SOURCES, Source, _put, substituted
from kinsym.kinematics.chain import build_chain
from kinsym.robot import from_inline
from kinsym.robot.model import Task
from tests.arms import robot

NAMES = ("sliding_rpr", "sliding_rrp", "sliding_prp", "cylindrical_wrist")


def begun(name: str) -> tuple[State, list[PoolEquation]]:
    """An arm of which nothing is known, and its equations."""
    chain = build_chain(robot(name))
    state, _ = start(chain, Task.POSE)
    pool = Pool(state)
    return state, [equation for cut in pool.cuts() for equation in pool.equations(cut)]


def unknowns(state: State) -> set[str]:
    """All cosines, sines and slides."""
    angles = {name for angle in state.chain.angles.values() for name in (angle.cosine, angle.sine)}
    return angles | {joint.variable for joint in state.chain.joints if joint.kind == "P"}


@pytest.mark.parametrize("name", NAMES)
def test_what_comes_out_holds_and_what_goes_in_is_bounded(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    state, equations = begun(name)
    put: list[tuple[PoolEquation, Source]] = []
    monkeypatch.setattr(
        substitution, "_put", lambda state, one, source: put.append((one, source)) or _put(state, one, source)
    )
    found = substituted(state, equations)
    assert found
    known = {equation.poly for equation in equations}
    for equation in found:
        assert state.vanishes(equation.poly)
        assert 0 < equation.unknowns <= 2
        assert equation.poly not in known
        names = [name for angle in equation.angles for name in (angle.cosine, angle.sine)]
        used, unknown = set(state.chain.ring.used(equation.poly)), unknowns(state)
        assert used & unknown <= {*names, *equation.lengths}
        assert set(equation.lengths) <= used
        assert all({angle.cosine, angle.sine} & used for angle in equation.angles)
        assert not set(state.chain.ring.used(equation.lhs)) & unknown
    for equation, source in put:
        left = {*equation.lengths, *source.equation.lengths} - {source.variable}
        left |= {angle.label for one in (equation, source.equation) for angle in one.angles}
        assert len(left) <= 2
        assert equation is not source.equation
        assert len(equation.poly) * len(source.rest) <= LONGEST
    for variable in {source.variable for _, source in put}:
        sources = {id(source.equation) for _, source in put if source.variable == variable}
        assert len(sources) <= SOURCES * ROUNDS


def test_a_length_is_replaced_up_to_its_square() -> None:
    """By hand: a d + 3 = 0 in d^2 + 2 d c1 + s1, times a^2, is 9 - 6 a c1 + a^2 s1; a cube is left alone."""
    chain = build_chain(from_inline("pi/2 0 d1 0; 0 a2 0 theta2; 0 a3 0 theta3", convention="paul", name="three"))
    ring, (state, _) = chain.ring, start(chain, Task.POSE)
    d, c, s, a, zero = ring["d1"], ring["c2"], ring["s2"], ring["a2"], ring.zero
    angle = next(angle for angle in chain.angles.values() if angle.label == "2")

    def put(poly: Poly, factor: Poly = a) -> PoolEquation | None:
        given = PoolEquation(zero, -(factor * d + 3), 1, "first", (), ("d1",))
        other = PoolEquation(zero, -poly, 2, "second", (angle,), ("d1",))
        return _put(state, other, Source(given, "d1", factor, ring.number(3)))

    found = put(d**2 + 2 * d * c + s)
    assert found is not None
    assert found.poly == 9 - 6 * a * c + a**2 * s
    assert (found.lhs, found.unit, found.angles, found.lengths) == (ring.number(9), 2, (angle,), ())
    assert found.source == "second, with d1 by first"
    divided = put(d**2 + 2 * d * c + s, ring.number(2))
    assert divided is not None
    assert 4 * divided.poly == 9 - 12 * c + 4 * s
    assert put(d**3 + c) is None
    # what is left of nothing, or without an unknown, is no equation
    assert put((a * d + 3) * c) is None
    assert put(d * a) is None
