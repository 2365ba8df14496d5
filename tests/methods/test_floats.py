"""Solutions of the methods, followed with floats: every joint is among the values that the page gives for it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from kinsym.kinematics.chain import Chain
from kinsym.methods import METHODS
from kinsym.methods.draft import Draft
from kinsym.robot import from_inline, load
from kinsym.robot.model import Robot
from tests.arms import SHAPES
from tests.methods.floats import Posture, follow

PIEPER = (
    "0 0 0 theta1; alpha1 a1 d2 theta2; alpha2 a2 d3 theta3; alpha3 a3 d4 theta4; alpha4 0 0 theta5; alpha5 0 0 theta6"
)
OFFSETS = (
    "0 0 d1 theta1; pi/2 a1 0 theta2+pi/2; 0 a2 0 theta3; pi/2 a3 d4 -theta4; -pi/2 0 0 theta5; pi/2 0 d6 theta6-pi/2"
)
SKEW_SLIDE = "0 0 0 theta1; deg(60) a1 l2 theta2; deg(30) a2 d3 0; pi/2 a3 l4 theta4; -pi/2 0 0 theta5; pi/2 0 0 theta6"
BENT = "0 0 0 theta1; pi/2 0 d2 theta2; 0 a2 0 theta3; -pi/2 a3 d4 theta4; pi/2 0 0 theta5; -pi/2 0 d6 theta6"
FLAT = "0 0 0 theta1; 0 a1 d2 theta2; deg(40) a2 d3 theta3; pi/2 a3 d4 theta4; -pi/2 0 0 theta5; pi/2 0 0 theta6"
FIRST = "0 0 0 theta1; pi/2 0 0 theta2; -pi/2 0 d3 theta3; pi/2 a3 d4 theta4; pi/2 a4 d5 theta5; pi/2 a5 0 theta6"
TABLES = {"first": FIRST, "pieper": PIEPER, "offsets": OFFSETS, "skew_slide": SKEW_SLIDE, "bent": BENT, "flat": FLAT}

CASES = [
    *(("pieper", robot) for robot in ("fanuc_s900w", "puma560", "stanford_paul", "nao_left_leg", *TABLES)),
    *(("zyz", robot) for robot in ("fanuc_s900w", "spherical_wrist", "puma560", "offsets", "stanford_screw")),
    *(
        ("screws_inverse", robot)
        for robot in ("elbow_6r_screw", "stanford_screw", "planar_rrr_screw", "ur5", "puma560", "scara", "scorbot_5r")
    ),
    *(("decoupled", robot) for robot in ("fanuc_s900w", "puma560", "abb_irb120")),
    *(("screws_inverse", robot) for robot in ("cylindrical_rpp", "elbow_rrr", "planar_rr", "spherical_wrist", "bent")),
    *(("geometric", robot) for robot in ("elbow_rrr", "puma560", "ur5", "elbow_6r_screw")),
]


def robot_of(name: str) -> Robot:
    return from_inline(TABLES[name], convention="craig", name=name) if name in TABLES else load(name)


@pytest.fixture
def chains(monkeypatch: pytest.MonkeyPatch) -> list[Chain]:
    """The chains that methods work on: tables are rewritten, and the screws have another end."""
    seen: list[Chain] = []
    begin: Callable[..., None] = Draft.__init__

    def noting(self: Draft, chain: Chain, **rest: object) -> None:
        seen.append(chain)
        begin(self, chain, **rest)

    monkeypatch.setattr(Draft, "__init__", noting)
    return seen


@pytest.mark.parametrize(("method", "name"), CASES)
def test_every_joint_is_among_its_solutions(method: str, name: str, chains: list[Chain]) -> None:
    derivation = METHODS[method](robot_of(name))
    assert derivation.solutions
    for seed in range(4):
        assert follow(derivation, Posture(chains[-1], seed)) == []


@pytest.mark.parametrize("name", ["parallel_123", "general_3r", "general_pieper", "skew_wrist"])
def test_reductions_to_a_polynomial(name: str, chains: list[Chain]) -> None:
    """Equations of a closed form that become quadratic, or of degree four, in the tangent of half an angle."""
    derivation = METHODS["half_angle"](from_inline(SHAPES[name], convention="paul", name=name))
    assert derivation.solutions
    for seed in range(4):
        assert follow(derivation, Posture(chains[-1], seed)) == []


@pytest.mark.parametrize("method", ["algebraic", "geometric"])
@pytest.mark.parametrize("name", ["planar_rr", "planar_rrr_craig", "planar_rrr_paul"])
def test_planar_arms(method: str, name: str, chains: list[Chain]) -> None:
    derivation = METHODS[method](load(name))
    for seed in range(4):
        posture = Posture(chains[-1], seed)
        x, y = posture.numbers["p_x"], posture.numbers["p_y"]
        posture.numbers.update(x_E=x, y_E=y)
        if len(chains[-1].joints) == 2:
            posture.numbers.update(x=x, y=y)
        else:
            posture.angles["phi"] = sum(posture.angles[f"theta{i}"] for i in (1, 2, 3))
        assert follow(derivation, posture) == []


def test_a_wrong_angle_is_seen(chains: list[Chain]) -> None:
    """The tests above mean nothing without it."""
    derivation = METHODS["screws_inverse"](load("elbow_6r_screw"))
    posture = Posture(chains[-1], 1)
    posture.angles["theta6"] += 0.1
    assert "theta6" in follow(derivation, posture)


REVERSED = "0 l1 0 -theta1; 0 l2 0 theta2; 0 l3 0 theta3"


@pytest.mark.parametrize("method", ["algebraic", "geometric"])
@pytest.mark.parametrize("table", [REVERSED, REVERSED.replace("l1", "phi").replace("l3", "x")])
def test_a_reversed_axis_and_names_that_are_taken(method: str, table: str, chains: list[Chain]) -> None:
    """Names of the method's own that the table has taken get an underscore: phi_, x_."""
    derivation = METHODS[method](from_inline(table, convention="paul", name="reversed"))
    for seed in range(4):
        posture = Posture(chains[-1], seed)
        posture.numbers.update(x_E=posture.numbers["p_x"], y_E=posture.numbers["p_y"])
        angles = [posture.angles[f"theta{i}"] for i in (1, 2, 3)]
        posture.angles["phi_" if "phi" in table else "phi"] = -angles[0] + angles[1] + angles[2]
        assert follow(derivation, posture) == []


BENT_LINK = "pi/2 0 0 theta1; 0 a2 0 theta2; -pi/2 a3 d3 theta3; pi/2 0 d4 theta4; -pi/2 0 0 theta5; 0 0 0 theta6"


@pytest.mark.parametrize(
    "table", [BENT_LINK, BENT_LINK.replace("d3 theta3", "d3 -theta3"), BENT_LINK.replace(" a3", " -a3")]
)
def test_a_bent_link_is_a_side_of_the_triangle(table: str, chains: list[Chain]) -> None:
    """The straight line from elbow to wrist, also where the table counts the elbow's angle the other way round."""
    derivation = METHODS["geometric"](from_inline(table, convention="paul", name="bent"))
    assert {"delta", "beta", "psi", "exists.near"} <= {equation.name for equation in derivation.equations}
    for seed in range(4):
        assert follow(derivation, Posture(chains[-1], seed)) == []
