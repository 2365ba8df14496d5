"""What the compiled functions are given: whatever NumPy reads as numbers; the rest is refused as the module does it."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from tests.extension.built import outcome, pair, same

Q = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])


def unaligned(array: np.ndarray) -> np.ndarray:
    """The same numbers at an address that is no multiple of eight."""
    raw = np.zeros(array.nbytes + 1, dtype=np.uint8)
    view = raw[1:].view(array.dtype).reshape(array.shape)
    view[...] = array
    return view


def read_only(array: np.ndarray) -> np.ndarray:
    """A copy that cannot be written."""
    copy = array.copy()
    copy.flags.writeable = False
    return copy


FORMS: dict[str, Callable[[np.ndarray], Any]] = {
    "as it is": lambda a: a,
    "list": lambda a: a.tolist(),
    "tuple of arrays": tuple,
    "fractions": np.vectorize(Fraction, otypes=[object]),
    "float32": lambda a: a.astype(np.float32),
    "long double": lambda a: a.astype(np.longdouble),
    "big endian": lambda a: a.astype(">f8"),
    "columns first": np.asfortranarray,
    "every second": lambda a: np.repeat(a, 2, axis=0)[::2],
    "backwards": lambda a: a[::-1].copy()[::-1],
    "unaligned": unaligned,
    "read-only": read_only,
    "memoryview": lambda a: memoryview(np.ascontiguousarray(a)),
}


@pytest.mark.parametrize("form", FORMS)
def test_numbers_in_any_form(form: str) -> None:
    """What NumPy takes is taken, with the same result as the module has."""
    package, module, *_ = pair("puma560")
    make = FORMS[form]
    T = package.fk(Q)
    limits = np.array([(-3.0, 3.0)] * 6)
    rounded = 1e-5 if form == "float32" else 1e-9
    for one in (package, module):
        assert same(one.fk(make(Q)), module.fk(Q), rounded)
        assert same(one.jacobian(make(Q)), module.jacobian(Q), rounded)
        if form == "float32":  # six digits are no rotation
            continue
        assert same(one.ik(make(T)), module.ik(T))
        assert same(one.ik_batch(make(T), reference=make(Q)), module.ik_batch(T, reference=Q))
        assert same(tuple(one.solve(make(T), reference=make(Q))), tuple(module.solve(T, reference=Q)))
        assert same(tuple(one.within(T, limits=make(limits))), tuple(module.within(T, limits=limits)))
        assert same(one.nearest(T, make(Q), weights=make(Q), limits=make(limits)), module.nearest(T, Q, weights=Q))


def test_numbers_that_are_no_floats() -> None:
    """Integers, NumPy's scalars and arrays of no axes as parameters and locked joints."""
    package, module, *_ = pair("kuka_iiwa")
    T = module.fk(np.full(7, 0.3))
    for value in (1, True, np.float64(0.3), np.float32(0.5), np.int64(1), np.array(0.3), Fraction(1, 4)):
        assert same(package.ik(T, theta3=value), module.ik(T, theta3=value))
        assert same(package.fk(np.ones(7), d1=value), module.fk(np.ones(7), d1=value))
        assert same(package.ik_batch(T, theta3=value), module.ik_batch(T, theta3=value))


T, BAD = np.eye(4), np.eye(4)
BAD[0, 0] = 1.001
LIMITS = np.array([(-3.0, 3.0)] * 6)
CALLS: dict[str, Callable[[Any], Any]] = {
    "fk, no vector": lambda m: m.fk(0.5),
    "fk, five joints": lambda m: m.fk(Q[:5]),
    "fk, six rows": lambda m: m.fk(np.zeros((6, 5))),
    "fk, nothing": lambda m: m.fk(None),
    "fk, words": lambda m: m.fk("123456"),
    "fk, a list of words": lambda m: m.fk(["a"] * 6),
    "fk, ragged": lambda m: m.fk([[1.0] * 6, [1.0] * 5]),
    "fk, complex": lambda m: m.fk([1j] * 6),
    "fk, bytes": lambda m: m.fk(b"123456"),
    "fk, a mapping": lambda m: m.fk({}),
    "fk, NaN goes through": lambda m: m.fk([np.nan] * 6),
    "fk, infinity goes through": lambda m: m.fk([np.inf] * 6),
    "fk, a parameter that is NaN": lambda m: m.fk(Q, a2=np.nan),
    "fk, an infinite parameter": lambda m: m.fk(Q, a2=-np.inf),
    "fk, a parameter that is a word": lambda m: m.fk(Q, d3="0.1"),
    "fk, a parameter that is None": lambda m: m.fk(Q, d3=None),
    "fk, a parameter with an axis": lambda m: m.fk(Q, d3=np.array([0.1, 0.2])),
    "jacobian, a parameter that is NaN": lambda m: m.jacobian(Q, d4=np.nan),
    "ik, three rows": lambda m: m.ik(T[:3]),
    "ik, many poses": lambda m: m.ik(np.zeros((2, 4, 4))),
    "ik, nothing": lambda m: m.ik(None),
    "ik, complex": lambda m: m.ik(T * 1j),
    "ik, NaN": lambda m: m.ik(T * np.nan),
    "ik, no rotation": lambda m: m.ik(BAD),
    "ik, a reflection": lambda m: m.ik(np.diag([-1.0, 1.0, 1.0, 1.0])),
    "ik, a parameter that is NaN": lambda m: m.ik(T, a3=np.nan),
    "ik, a reference that is NaN": lambda m: m.ik(T, reference=Q * np.nan),
    "ik, out of reach": lambda m: m.ik(T + np.diag([0, 0, 0], 1)[:4, :4] + 9.0 * np.eye(4, k=3)),
    "ik_batch, one is no pose": lambda m: m.ik_batch(np.stack([T, T, BAD, BAD])),
    "ik_batch, rows": lambda m: m.ik_batch(np.zeros((5, 3, 4))),
    "ik_batch, a reference too many": lambda m: m.ik_batch(np.stack([T, T]), reference=np.zeros((3, 6))),
    "ik_batch, a reference that is NaN": lambda m: m.ik_batch(np.stack([T, T]), reference=Q * np.nan),
    "solve, three rows": lambda m: m.solve(T[:3]),
    "solve, many poses": lambda m: m.solve(np.zeros((2, 4, 4))),
    "solve, no pose": lambda m: m.solve(BAD),
    "solve, NaN": lambda m: m.solve(T * np.nan),
    "solve, a reference of two": lambda m: m.solve(T, reference=np.zeros((2, 6))),
    "solve, a short reference": lambda m: m.solve(T, reference=Q[:3]),
    "solve, an infinite reference": lambda m: m.solve(T, reference=Q * np.inf),
    "within, limits that are swapped": lambda m: m.within(T, limits=LIMITS[:, ::-1]),
    "within, limits that are NaN": lambda m: m.within(T, limits=LIMITS * np.nan),
    "within, limits that are bounds": lambda m: m.within(T, limits=LIMITS.T),
    "within, no pose": lambda m: m.within(BAD, limits=LIMITS),
    "within, nothing fits": lambda m: m.within(m.fk(Q), limits=LIMITS * 0.0),
    "within, too many fit": lambda m: m.within(m.fk(Q), limits=LIMITS * 10.0),
    "nearest, no pose": lambda m: m.nearest(BAD, Q),
    "nearest, a reference of None": lambda m: m.nearest(m.fk(Q), None),
    "nearest, a reference that is NaN": lambda m: m.nearest(T, Q * np.nan),
    "nearest, a weight below zero": lambda m: m.nearest(T, Q, weights=[1, 1, -1, 1, 1, 1]),
    "nearest, a weight that is NaN": lambda m: m.nearest(T, Q, weights=[1, 1, np.nan, 1, 1, 1]),
    "nearest, five weights": lambda m: m.nearest(T, Q, weights=[1.0] * 5),
    "nearest, limits that are swapped": lambda m: m.nearest(T, Q, limits=LIMITS[:, ::-1]),
    "nearest, nothing fits": lambda m: m.nearest(m.fk(Q), Q, limits=LIMITS * 0.0),
    "an argument too many": lambda m: m.ik(T, Q),
    "a name that is none": lambda m: m.ik(T, a9=1.0),
}


@pytest.mark.parametrize("case", CALLS)
def test_same_refusals(case: str) -> None:
    """The same exception with the same words as the module, or the same answer."""
    package, module, *_ = pair("puma560")
    with np.errstate(invalid="ignore"):
        own, other = (outcome(lambda one=one: CALLS[case](one)) for one in (package, module))
    assert same(own, other), (own, other)


def test_more_windings_than_an_int_counts() -> None:
    """C stops counting there, and says so."""
    package, module, *_ = pair("puma560")
    pose, limits = module.fk(Q), LIMITS * 40.0
    with pytest.raises(ValueError, match="25402467013 joint vectors"):
        module.within(pose, limits=limits)
    with pytest.raises(ValueError, match="2147483647 or more joint vectors"):
        package.within(pose, limits=limits)


LOCKED: dict[str, Callable[[Any], Any]] = {
    "missing": lambda m: m.ik(T),
    "NaN": lambda m: m.ik(T, theta3=np.nan),
    "infinite": lambda m: m.solve(T, theta3=np.inf),
    "a word": lambda m: m.ik(T, theta3="x"),
    "None": lambda m: m.ik(T, theta3=None),
    "many for ik": lambda m: m.ik(T, theta3=[0.1, 0.2]),
    "many for solve": lambda m: m.solve(T, theta3=[0.1, 0.2]),
    "many for nearest": lambda m: m.nearest(T, np.zeros(7), theta3=[0.1, 0.2]),
    "NaN among many": lambda m: m.ik_batch(T, theta3=[0.1, np.nan]),
    "too many for the poses": lambda m: m.ik_batch(np.stack([T, T]), theta3=[0.1, 0.2, 0.3]),
    "many poses for a sweep": lambda m: m.ik_sweep(np.stack([T, T]), theta3=[0.1, 0.2]),
}


@pytest.mark.parametrize("case", LOCKED)
def test_same_refusals_of_a_locked_joint(case: str) -> None:
    """Values of an input that are missing, no numbers, or too many."""
    package, module, *_ = pair("kuka_iiwa")
    own, other = (outcome(lambda one=one: LOCKED[case](one)) for one in (package, module))
    assert same(own, other), (own, other)


def test_a_parameter_without_a_value() -> None:
    """It has to be given, as in the module."""
    package, module, *_ = pair("planar_rr")
    own, other = (outcome(lambda one=one: one.fk([0.1, 0.2], l1=0.3)) for one in (package, module))
    assert own[0] is other[0] is TypeError
    assert "l2" in own[1]


@pytest.mark.parametrize("function", ["fk", "jacobian", "ik", "ik_batch", "solve", "within", "nearest"])
def test_the_core_counts_its_arguments(function: str) -> None:
    """Called past its Python file it raises, whatever it is given; it never reads what is not there."""
    core = getattr(pair("kuka_iiwa").package._core, function)
    for number in range(12):
        for thing in (None, 0.5, np.eye(4), np.zeros((0, 7))):
            with pytest.raises((TypeError, ValueError)):
                core(*[thing] * number)
    with pytest.raises(TypeError):
        core(T=np.eye(4))


def test_rows_of_a_batch_belong_together() -> None:
    """The core refuses fewer references or values than poses."""
    core = pair("kuka_iiwa").package._core
    poses, lengths = np.stack([T] * 3), (0.36, 0.42, 0.4, 0.126)
    for references, values in ((np.zeros((2, 7)), np.zeros((3, 1))), (None, np.zeros((2, 1))), (None, None)):
        with pytest.raises(ValueError, match=r"one for each pose|must have the shape"):
            core.ik_batch(poses, references, values, *lengths)


def test_parameters_that_must_not_vanish_are_refused() -> None:
    """Every function names them, and none says that the pose is out of reach or none."""
    package, module, *_ = pair("scara")
    given: dict[str, float] = dict.fromkeys(package.PARAMETERS, 0.3)
    q = np.array([0.1, 0.2, 0.3, 0.4])
    T = package.fk(q, **given)
    for name in ("a1", "a2"):
        broken = {**given, name: 0.0}
        for one in (package, module):
            assert one.fk(q, **broken).shape == (4, 4)
            for call in (one.ik, one.ik_batch, one.solve, one.within):
                with pytest.raises(ValueError, match=f"{name}.*vanish|vanishes.*{name}"):
                    call(T, **broken)
            with pytest.raises(ValueError, match=f"{name}.*vanish|vanishes.*{name}"):
                one.nearest(T, q, **broken)
