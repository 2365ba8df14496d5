"""Nothing false is ever stated: the proof sees wrong signs, wrong branches and names without a value."""

from __future__ import annotations

import contextlib
from fractions import Fraction

import pytest

from kinsym.algebra.nested import number
from kinsym.algebra.tree import Call, Pi, PlusMinus, Pow, Quot, Sym, add, mul, negated, sub
from kinsym.errors import KinsymError
from kinsym.kinematics.chain import build_chain
from kinsym.methods import METHODS
from kinsym.methods.document import INVERSE, Factor, Matrix, Product
from kinsym.methods.draft import Draft
from kinsym.methods.proof import ProofFailed, Witness
from kinsym.robot import from_inline, gallery, load
from tests.arms import SHAPES

C1, S1, C2, L1, L2 = (Sym(name) for name in ("c1", "s1", "c2", "l1", "l2"))


@pytest.fixture
def draft() -> Draft:
    return Draft(build_chain(load("planar_rr")), method="test", title="Test")


def test_what_holds_is_stated(draft: Draft) -> None:
    squares = add(Pow(Sym("p_x"), 2), Pow(Sym("p_y"), 2))
    cosines = add(Pow(L1, 2), Pow(L2, 2), mul(number(2), L1, L2, C2))
    draft.state("squares", squares, cosines)
    draft.solve("theta2", PlusMinus(None, Call("acos", (C2,))), branches=2)
    draft.solve("theta1", Call("atan2", (S1, C1)), branches=1)
    assert [equation.number for equation in draft.done().equations] == [1, 2, 3]


def test_a_wrong_sign_is_refused(draft: Draft) -> None:
    with pytest.raises(ProofFailed, match="squares does not hold"):
        draft.state("squares", Pow(C1, 2), sub(Pow(S1, 2), number(1)))
    with pytest.raises(ProofFailed):
        draft.solve("theta1", Call("atan2", (C1, S1)), branches=1)
    with pytest.raises(ProofFailed):
        draft.solve("theta1", Call("atan2", (negated(S1), C1)), branches=1)
    with pytest.raises(ProofFailed):
        draft.solve("theta2", add(Sym("theta12"), Sym("theta1")), branches=1)
    assert draft.done().equations == ()


def test_a_root_must_be_that_of_the_joint(draft: Draft) -> None:
    draft.state("either", Sym("s2"), PlusMinus(None, Call("sqrt", (sub(number(1), Pow(C2, 2)),))))
    with pytest.raises(ProofFailed):
        draft.state("other", Sym("s2"), Call("sqrt", (sub(number(2), Pow(C2, 2)),)))


def test_what_has_no_value_is_no_proof() -> None:
    """A matrix beside a number, two values where one is wanted, a number where an angle stands, and the reverse."""
    at = Witness(numbers={"c1": 3}, angles={"theta1": (3, 5)})
    with pytest.raises(ProofFailed, match="a matrix is said to equal a number"):
        at.holds(Matrix(((C1,),)), C1)
    with pytest.raises(ProofFailed, match="has 2 values where one is expected"):
        at.value(PlusMinus(None, C1))
    with pytest.raises(ProofFailed, match="is no number"):
        at.values(Call("atan2", (C1, C1)))
    with pytest.raises(ProofFailed, match="is no angle"):
        at.directions(Quot(Sym("theta1"), C1))
    assert at.directions(number(0)) == {(1, 0)}
    assert at.holds(Call("abs", (negated(C1),)), C1)
    assert not at.holds(Call("abs", (C1,)), number(2))


def test_matrices(draft: Draft) -> None:
    turn = Matrix(((C1, negated(S1)), (S1, C1)))
    draft.name_matrix("R", turn)
    draft.state("square", Product((Factor("R"), Matrix(((C1,), (S1,))))), Matrix(_doubled()))
    with pytest.raises(ProofFailed):
        draft.state("wrong", Product((Factor("R"), Matrix(((C1,), (S1,))))), Matrix(((C1,), (S1,))))


def _doubled() -> tuple[tuple[object], tuple[object]]:
    return (sub(Pow(C1, 2), Pow(S1, 2)),), (mul(number(2), C1, S1),)


def test_a_rigid_inverse(draft: Draft) -> None:
    zero, one = number(0), number(1)
    pose = Matrix(((C1, negated(S1), zero, L1), (S1, C1, zero, L2), (zero, zero, one, zero), (zero, zero, zero, one)))
    draft.name_matrix("T", pose)
    unit = tuple(tuple(number(int(i == j)) for j in range(4)) for i in range(4))
    draft.state("unit", Product((Factor("T", INVERSE), Factor("T"))), Matrix(unit))


def test_a_name_without_a_value_is_refused(draft: Draft) -> None:
    with pytest.raises(ProofFailed, match="nothing has no value"):
        draft.state("empty", Sym("nothing"), number(0))


def test_one_name_is_one_equation(draft: Draft) -> None:
    draft.state("one", C1, C1)
    with pytest.raises(ValueError, match="two equations are called one"):
        draft.state("one", S1, S1)


def test_fractions_of_pi(draft: Draft) -> None:
    half = Quot(Pi(), number(2))
    draft.state("shift", Call("cos", (sub(half, Sym("theta1")),)), S1)
    with pytest.raises(ProofFailed):
        draft.state("no shift", Call("cos", (sub(Pi(), Sym("theta1")),)), S1)
    with pytest.raises(ProofFailed, match="no exact cosine"):
        draft.state("odd", Call("cos", (Quot(Pi(), number(Fraction(11))),)), S1)


@pytest.mark.parametrize("method", ["craig", "paul", "screws", "frames", "loop_closure"])
def test_forward_methods_hold_for_the_gallery(method: str) -> None:
    """Every equation is proved as it is made, so a derivation that comes out is a proof; most arms have one."""
    found = 0
    for name in list(gallery())[::3]:
        with contextlib.suppress(KinsymError):
            found += bool(METHODS[method](load(name)).equations)
    assert found >= {"loop_closure": 2, "craig": 14, "paul": 14}.get(method, 16)


@pytest.mark.parametrize("method", ["algebraic", "half_angle"])
@pytest.mark.parametrize("name", ["sliding_rrp", "sliding_ends", "parallel_123", "symbolic_pieper", "skew_wrist"])
def test_plans_of_every_rule_are_proved_again(method: str, name: str) -> None:
    """Polynomials of degree four in an angle and in a length, d = size tan(phi/2), bent links, reversed axes."""
    assert METHODS[method](from_inline(SHAPES[name], convention="paul", name=name)).equations
