"""Status, joint limits and the nearest solution: NumPy and C answer alike, and both answer right."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest

from kinsym.robot import from_inline
from tests.arms import numpy_module
from tests.control.both import array, c_control, case, sample
from tests.emit.built import needs_compiler

ARMS = (
    "puma560",
    "ur5",
    "stanford_paul",
    "kuka_iiwa",
    "panda_held",
    "rail",
    "planar_rrr_paul",
    "scara",
    "scorbot_5r",
    "general_pieper",
    "planar_rpr",
    "three_slides",
)
FULL = 2 * math.pi


def pose(name: str, q: Any) -> Any:
    """The pose of a joint vector."""
    found = case(name)
    return found.module.fk(q, **found.keywords)


def solve(name: str, T: Any, **options: Any) -> Any:
    """The module's solve."""
    found = case(name)
    return found.module.solve(T, **found.inputs, **found.keywords, **options)


def within(name: str, T: Any, **options: Any) -> Any:
    """The module's within."""
    found = case(name)
    return found.module.within(T, **found.inputs, **found.keywords, **options)


def nearest(name: str, T: Any, reference: Any, **options: Any) -> Any:
    """The module's nearest."""
    found = case(name)
    return found.module.nearest(T, reference, **found.inputs, **found.keywords, **options)


def wide(name: str) -> Any:
    """Limits of one turn and a half for what is wound, of ten units for lengths, around zero."""
    kinds = case(name).module.JOINT_TYPES
    return np.array([[-1.5 * math.pi, 1.5 * math.pi] if kind == "R" else [-10.0, 10.0] for kind in kinds])


@needs_compiler
@pytest.mark.parametrize("name", ARMS)
def test_both_languages_give_the_same_answers(name: str) -> None:
    c, given, limits = c_control(name), case(name).given, wide(name)
    assert c.branches == list(case(name).module.BRANCHES)
    np.testing.assert_array_equal(c.limits(), case(name).module.LIMITS)
    for seed in range(12):
        q = sample(name, seed)
        T, reference = pose(name, q), q + np.random.default_rng(seed).normal(0.0, 3.0, len(q))
        for T_ in (T, T @ np.diag([1.0, -1.0, -1.0, 1.0]), np.zeros((4, 4))):
            left, right = solve(name, T_, reference=reference), c.solved(T_, given, reference)
            assert left.status == right.status
            assert left.branch.tolist() == right.branch
            np.testing.assert_allclose(left.q, right.q, atol=1e-9)
            np.testing.assert_array_equal(left.free, right.free)
            np.testing.assert_array_equal(left.border, right.border)
        number, written = c.inside(T, given, reference, limits)
        found = within(name, T, reference=reference, limits=limits)
        assert number == len(found.q) >= 1
        assert written.branch == found.branch.tolist()
        np.testing.assert_allclose(written.q, found.q, atol=1e-9)
        weights = np.random.default_rng(seed).uniform(0.0, 2.0, len(q))
        for options in ({}, {"weights": weights}, {"limits": limits}):
            status, vector = c.closest(T, reference, given, **options)
            expected = nearest(name, T, reference, **options)
            assert (status == "unreachable") == (vector is None) == (expected is None)
            assert vector is None or np.abs(vector - expected).max() < 1e-9


@pytest.mark.parametrize("name", ARMS)
def test_the_nearest_solution_is_the_best_of_all_windings(name: str) -> None:
    """Against every winding written out, with and without weights."""
    module, limits = case(name).module, wide(name)
    for seed in range(6):
        q = sample(name, seed)
        T, generator = pose(name, q), np.random.default_rng(seed)
        reference = q + generator.normal(0.0, 1.0, len(q))
        weights = generator.uniform(0.1, 2.0, len(q))
        every = [
            vector
            for row in solve(name, T, reference=reference).q
            for turns in itertools.product(
                *(
                    (-1, 0, 1) if kind == "R" and joint not in getattr(module, "LOCKED", {}) else (0,)
                    for kind, joint in zip(module.JOINT_TYPES, module.JOINTS, strict=True)
                )
            )
            if (np.abs(vector := row + FULL * np.array(turns)) <= limits[:, 1]).all()
        ]
        found = within(name, T, reference=reference, limits=limits)
        assert len(found.q) == len(every)
        np.testing.assert_allclose(np.sort(found.q, axis=0), np.sort(every, axis=0), atol=1e-12)
        costs = (weights * (np.array(every) - reference) ** 2).sum(axis=1)
        best = nearest(name, T, reference, weights=weights, limits=limits)
        assert (weights * (best - reference) ** 2).sum() == pytest.approx(costs.min(), rel=1e-8)
        assert np.abs(pose(name, best) - T).max() < 1e-9


def test_a_wound_reference_is_found_again() -> None:
    """Several turns away, and exactly half a turn away."""
    q = np.array([0.3, -0.7, 0.4, 0.6, 0.8, -0.2]) + FULL * np.array([0, 1, -3, 0, 2, 0])
    np.testing.assert_allclose(nearest("ur5", pose("ur5", q), q), q, atol=1e-10)


def test_a_length_is_never_wound() -> None:
    q = np.array([0.3, 0.5, 20.0, 0.4, 0.7, -0.6])
    T = pose("stanford_paul", q)
    assert nearest("stanford_paul", T, [0.3, 0.5, 0.2, 0.4, 0.7, -0.6])[2] == pytest.approx(20.0)
    limits = [(-7.0, 7.0)] * 2 + [(0.0, 30.0)] + [(-7.0, 7.0)] * 3
    assert set(np.round(within("stanford_paul", T, limits=limits).q[:, 2], 9)) == {20.0}
    assert within("stanford_paul", T, limits=[*limits[:2], (0.0, 19.0), *limits[3:]]).status == "unreachable"


def test_a_locked_joint_is_left_as_it_is_given() -> None:
    """Neither wound nor put onto a limit; outside its limits nothing is inside them."""
    module = numpy_module("kuka_iiwa")
    T = module.fk([0.1, 0.2, 0.4, 0.6, 0.5, 0.6, 0.7])
    reference = np.array([0.1, 0.2, 9.0, 0.6, 0.5, 0.6, 0.7])
    assert module.nearest(T, reference, theta3=0.4)[2] == 0.4
    limits = np.array(module.LIMITS)
    limits[2] = 0.4 + 5e-13, 1.0
    assert (module.within(T, theta3=0.4, limits=limits).q[:, 2] == 0.4).all()
    limits[2] = 0.5, 1.0
    assert module.nearest(T, reference, theta3=0.4, limits=limits) is None
    assert len(module.within(T, theta3=0.4, limits=[(-9.0, 9.0)] * 7).q) == sum(
        math.prod(sum(abs(x + FULL * k) <= 9.0 for k in range(-2, 3)) for x in np.delete(row, 2))
        for row in module.ik(T, theta3=0.4)
    )


def test_the_table_s_limits_are_the_default() -> None:
    module = numpy_module("kuka_iiwa")
    assert module.LIMITS[1] == pytest.approx((-math.radians(120), math.radians(120)))
    T = module.fk([0.1, 2.0, 0.4, -2.0, 0.5, 0.6, 0.7])
    found, every = module.within(T, theta3=0.4), module.ik(T, theta3=0.4)
    bounds = np.array(module.LIMITS)
    inside = ((every >= bounds[:, 0]) & (every <= bounds[:, 1])).all(axis=1)
    assert 0 < inside.sum() < len(every)
    np.testing.assert_array_equal(found.q, every[inside])
    np.testing.assert_array_equal(found.branch, module.solve(T, theta3=0.4).branch[inside])


def test_a_joint_that_stands_on_its_limit_is_inside() -> None:
    """The solution is a rounding error beyond it and is put onto it."""
    q = np.array([0.3, -0.7, 0.4, 0.6, 0.8, -0.2])
    limits = np.array([(value, value) for value in q])
    found = nearest("puma560", pose("puma560", q), q, limits=limits)
    np.testing.assert_array_equal(found, q)
    assert len(within("puma560", pose("puma560", q), limits=limits).q) == 1
    assert nearest("puma560", pose("puma560", q), q, limits=limits + [[1e-9, 1e-9]] * 6) is None


def test_without_limits_nothing_is_wound_and_one_end_alone_filters() -> None:
    T = pose("puma560", [0.3, -0.7, 0.4, 0.6, 0.8, -0.2])
    every = solve("puma560", T)
    np.testing.assert_array_equal(within("puma560", T).q, every.q)
    half = within("puma560", T, limits=[(0.0, math.inf)] + [(-math.inf, math.inf)] * 5)
    np.testing.assert_array_equal(half.q, every.q[every.q[:, 0] >= 0.0])


def test_status_tells_what_a_pose_is() -> None:
    arm = [0.3, -0.7, 0.4, 0.6, 0.8, -0.2]
    straight = [0.3, -0.7, 0.4, 0.6, 0.0, -0.2]
    assert solve("puma560", pose("puma560", arm)).status == "solved"
    found = solve("puma560", pose("puma560", straight), reference=straight)
    assert found.status == "singular"
    row = int(np.abs(found.q - straight).max(axis=1).argmin())
    assert found.free[row].tolist() == [False, False, False, True, False, False]
    far = pose("puma560", arm)
    far[:3, 3] *= 100.0
    assert solve("puma560", far).status == "unreachable"
    assert nearest("puma560", far, arm) is None
    assert solve("puma560", np.full((4, 4), np.nan)).status == "not a pose"
    assert len(solve("puma560", np.zeros((4, 4))).q) == 0
    assert within("puma560", np.zeros((4, 4))).status == "not a pose"


@needs_compiler
def test_the_result_says_which_joints_form_the_family() -> None:
    """theta4 and theta6 of a straight wrist; of a UR5 the three parallel joints and theta6."""
    for name, q, moving in (
        ("puma560", [0.3, -0.7, 0.4, 0.6, 0.0, -0.2], [3, 5]),
        ("ur5", [0.3, -0.7, 0.4, 0.6, 0.0, -0.2], [1, 2, 3, 5]),
    ):
        found = solve(name, pose(name, q), reference=q)
        rows = found.free.any(axis=1)
        assert rows.any()
        assert all(np.flatnonzero(family).tolist() == moving for family in found.family[rows])
        assert not found.family[~rows].any()
        bits = sum(1 << int(joint) for joint in np.flatnonzero(found.free[rows][0]))
        assert c_control(name).family(bits) == sum(1 << joint for joint in moving)
        assert c_control(name).family(0) == 0


def test_the_border_of_the_workspace_is_singular() -> None:
    q = np.array([0.4, 0.0])
    found = solve("planar_rr", pose("planar_rr", q))
    assert (found.status, found.border.tolist()) == ("singular", [[False, True]])


def test_a_free_joint_takes_its_reference_in_the_nearest_solution() -> None:
    q = np.array([0.3, -0.7, 0.4, 1.1 + FULL, 0.0, -0.2])
    np.testing.assert_allclose(nearest("puma560", pose("puma560", q), q), q, atol=1e-9)


def test_ties_go_to_the_first_branch() -> None:
    """Weights of zero make every solution as near as any other."""
    T = pose("ur5", [0.3, -0.7, 0.4, 0.6, 0.8, -0.2])
    found = nearest("ur5", T, np.zeros(6), weights=np.zeros(6))
    np.testing.assert_allclose(found, solve("ur5", T).q[0], atol=1e-12)


@needs_compiler
def test_a_mirrored_elbow_is_a_tie_in_both_languages() -> None:
    """Stretched along x with both elbows equally far from zero."""
    T = np.eye(4)
    T[0, 3] = 0.37
    given = case("planar_rr").given
    status, vector = c_control("planar_rr").closest(T, np.zeros(2), given)
    assert status == "solved"
    np.testing.assert_allclose(vector, nearest("planar_rr", T, np.zeros(2)), atol=1e-12)
    np.testing.assert_allclose(vector, solve("planar_rr", T).q[0], atol=1e-12)


HOSTILE: dict[str, tuple[dict[str, Any], str, str]] = {
    "NaN limit": ({"limits": [(math.nan, 1.0)] + [(-4.0, 4.0)] * 5}, "limits of theta1", "limit"),
    "exchanged": ({"limits": [(-4.0, 4.0)] * 5 + [(1.0, -1.0)]}, "limits of theta6", "limit"),
    "both at infinity": ({"limits": [(math.inf, math.inf)] + [(-4.0, 4.0)] * 5}, "limits of theta1", "limit"),
    "negative weight": ({"weights": [1.0, 1.0, -1e-9, 1.0, 1.0, 1.0]}, "weight of theta3", "weight"),
    "infinite weight": ({"weights": [1.0, math.inf, 1.0, 1.0, 1.0, 1.0]}, "weight of theta2", "weight"),
    "NaN weight": ({"weights": [math.nan] + [1.0] * 5}, "weight of theta1", "weight"),
}


@needs_compiler
@pytest.mark.parametrize("what", HOSTILE)
def test_limits_and_weights_are_refused_by_name(what: str) -> None:
    options, words, status = HOSTILE[what]
    T, c = pose("puma560", np.full(6, 0.3)), c_control("puma560")
    with pytest.raises(ValueError, match=words):
        nearest("puma560", T, np.zeros(6), **options)
    assert c.closest(T, np.zeros(6), None, **options) == (status, None)
    if "limits" in options:
        with pytest.raises(ValueError, match=words):
            within("puma560", T, **options)
        assert c.inside(T, limits=options["limits"])[0] == -4


@needs_compiler
def test_other_hostile_arguments_are_refused() -> None:
    T, c = pose("puma560", np.full(6, 0.3)), c_control("puma560")
    bad = [0.0, math.nan, 0.0, 0.0, 0.0, 0.0]
    with pytest.raises(ValueError, match="finite"):
        solve("puma560", T, reference=bad)
    with pytest.raises(ValueError, match="finite"):
        nearest("puma560", T, bad)
    assert c.closest(T, bad)[0] == c.solved(T, None, bad).status == "reference"
    assert c.solved(T, [math.nan] * 4).status == "parameter"
    assert c.closest(np.zeros((4, 4)), np.zeros(6))[0] == "not a pose"
    with pytest.raises(ValueError, match="rigid motion"):
        nearest("puma560", np.zeros((4, 4)), np.zeros(6))
    for shape in ((3, 3), (2, 4, 4), (4,)):
        with pytest.raises(ValueError, match="shape"):
            solve("puma560", np.zeros(shape))
    with pytest.raises(ValueError, match="shape"):
        nearest("puma560", T, np.zeros((2, 6)))
    with pytest.raises(ValueError, match="shape"):
        nearest("puma560", T, np.zeros(6), weights=1.0)
    with pytest.raises(ValueError, match="shape"):
        within("puma560", T, limits=[(-1.0, 1.0)] * 5)
    module = numpy_module("kuka_iiwa")
    with pytest.raises(ValueError, match="theta3 must be finite"):
        module.solve(np.zeros((4, 4)), theta3=math.nan)
    with pytest.raises(ValueError, match="one value of theta3"):
        module.solve(np.eye(4), theta3=[0.1, 0.2])


@needs_compiler
def test_the_buffer_of_c_is_never_overrun_and_the_number_is_bounded() -> None:
    T, c = pose("ur5", [0.3, -0.7, 0.4, 0.6, 0.8, -0.2]), c_control("ur5")
    limits = [(-FULL, FULL)] * 6
    number, every = c.inside(T, limits=limits)
    assert number == len(every.q) == 8 * 2**6
    for capacity in (0, 1, 65):
        again, some = c.inside(T, limits=limits, capacity=capacity)
        assert again == number
        np.testing.assert_array_equal(some.q, every.q[:capacity])
    assert c.within(array(T), None, None, *map(array, np.transpose([(-1e300, 1e300)] * 6)), 0, None, None) == 2**31 - 1
    with pytest.raises(ValueError, match="narrow them"):
        within("ur5", T, limits=[(-1e6, 1e6)] * 6)


def test_names_that_the_functions_need_cannot_be_parameters() -> None:
    for name in ("limits", "weights", "solve", "found", "status"):
        with pytest.raises(Exception, match="used by the generated code"):
            from_inline(f"0 {name} 0 theta1", convention="paul", name="arm")
