"""Arms for tests: the gallery, and tables of shapes that the gallery does not have."""

from __future__ import annotations

import tomllib
import types
from functools import cache
from typing import Any

from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit import TARGETS
from kinsym.emit.program import build_schedule
from kinsym.robot import from_inline, load, lock, to_toml
from kinsym.robot.files import from_draft
from kinsym.robot.model import Robot

SHAPES = {
    "shoulder_offset": "pi/2 a1 d1 theta1; 0 a2 0 theta2+pi/2; pi/2 a3 0 theta3; "
    "-pi/2 0 d4 theta4; pi/2 0 0 theta5; 0 0 d6 theta6",
    "reversed_axes": "pi/2 a1 d1 -theta1; pi a2 0 theta2; pi/2 a3 0 pi-theta3; "
    "-pi/2 0 d4 theta4; pi/2 0 0 -theta5; pi 0 d6 theta6+pi/2",
    "gantry_wrist": "pi/2 0 d1 0; pi/2 0 d2 pi/2; 0 0 d3 0; -pi/2 0 0 theta4; pi/2 0 0 theta5; 0 0 l6 theta6",
    "skew_wrist": "pi/2 a1 0 theta1; 0 a2 0 theta2; pi/2 a3 0 theta3; "
    "deg(60) 0 d4 theta4; -deg(60) 0 0 theta5; 0 0 d6 theta6",
    "skew_shoulder": "deg(30) a1 0 theta1; 0 a2 0 theta2; pi/2 a3 0 theta3; "
    "-pi/2 0 d4 theta4; pi/2 0 0 theta5; 0 0 d6 theta6",
    "cylindrical_wrist": "0 0 l1 theta1; -pi/2 0 d2 0; 0 0 d3 0; pi/2 0 0 theta4; -pi/2 0 0 theta5; 0 0 d6 theta6",
    "scara_wrist": "0 a1 l1 theta1; 0 a2 0 theta2; 0 0 d3 0; pi/2 0 0 theta4; -pi/2 0 0 theta5; 0 0 l6 theta6",
    "wrist_first": "pi/2 0 0 theta1; -pi/2 0 0 theta2; pi/2 a3 d3 theta3; "
    "0 a4 0 theta4; pi/2 a5 d5 theta5; 0 0 d6 theta6",
    "parallel_last": "pi/2 a1 d1 theta1; pi/2 0 d2 theta2; pi/2 0 d3 theta3; "
    "0 a4 0 theta4; 0 a5 0 theta5; 0 a6 d6 theta6",
    "slide_and_two": "pi/2 0 d1 0; 0 a2 0 theta2; 0 a3 0 theta3",
    "planar_rpr": "pi/2 a1 0 theta1; -pi/2 0 d2 0; 0 a3 0 theta3",
    "spherical_rrp": "pi/2 0 l1 theta1; pi/2 0 l2 theta2; 0 0 d3 0",
    "three_slides": "pi/2 0 d1 0; pi/2 0 d2 pi/2; 0 0 d3 0",
    "single": "0 a1 0 theta1",
    "four_joints": "pi/2 0 d1 theta1; 0 a2 0 theta2; 0 a3 0 theta3; 0 a4 0 theta4",
    "general_3r": "pi/2 a1 d1 theta1; pi/2 a2 d2 theta2; 0 a3 0 theta3",
    "general_pieper": "pi/2 a1 d1 theta1; pi/2 a2 d2 theta2; pi/2 a3 d3 theta3; "
    "-pi/2 0 d4 theta4; pi/2 0 0 theta5; 0 0 d6 theta6",
    "symbolic_pieper": "alpha1 a1 d1 theta1; alpha2 a2 d2 theta2; alpha3 a3 d3 theta3; "
    "-pi/2 0 d4 theta4; pi/2 0 0 theta5; 0 0 d6 theta6",
    "pieper_first": "pi/2 0 0 theta1; -pi/2 0 0 theta2; pi/2 a3 d3 theta3; "
    "pi/2 a4 d4 theta4; pi/2 a5 d5 theta5; 0 a6 d6 theta6",
    "parallel_123": "0 a1 d1 theta1; 0 a2 d2 theta2; pi/2 a3 d3 theta3; "
    "pi/2 a4 d4 theta4; pi/2 a5 d5 theta5; 0 a6 d6 theta6",
    "meeting_234": "pi/2 a1 d1 theta1; pi/2 0 d2 theta2; pi/2 0 0 theta3; "
    "pi/2 a4 d4 theta4; pi/2 a5 d5 theta5; 0 a6 d6 theta6",
    "meeting_345": "pi/2 a1 d1 theta1; pi/2 a2 d2 theta2; pi/2 0 d3 theta3; "
    "pi/2 0 0 theta4; pi/2 a5 d5 theta5; 0 a6 d6 theta6",
    "sliding_rpr": "deg(60) a1 l1 theta1; deg(30) a2 d2 0; deg(45) a3 l3 theta3; "
    "-pi/2 0 l4 theta4; pi/2 0 0 theta5; 0 0 l6 theta6",
    "sliding_rrp": "deg(60) a1 l1 theta1; deg(45) a2 l2 theta2; deg(30) a3 d3 0; "
    "-pi/2 0 l4 theta4; pi/2 0 0 theta5; 0 0 l6 theta6",
    "sliding_prp": "deg(60) a1 d1 0; pi/2 a2 l2 theta2; deg(45) a3 d3 0; "
    "-pi/2 0 l4 theta4; pi/2 0 0 theta5; 0 0 l6 theta6",
    "sliding_ends": "pi/2 a1 d1 0; pi/2 0 l2 theta2; pi/2 0 0 theta3; "
    "deg(45) a4 l4 theta4; deg(45) a5 d5 0; 0 0 0 theta6",
    "slides_between": "pi/2 a1 l1 theta1; deg(30) a2 d2 0; deg(60) a3 l3 theta3; "
    "pi/2 a4 d4 0; deg(45) a5 l5 theta5; 0 a6 d6 0",
    "five_joints": "pi/2 0 d1 theta1; 0 a2 0 theta2; pi/2 0 0 theta3; -pi/2 0 d4 theta4; 0 0 d5 theta5",
}
"""Paul tables, cells alpha a d theta."""

IIWA = (
    "-pi/2 0 d1 theta1; pi/2 0 0 theta2; pi/2 0 d3 theta3; -pi/2 0 0 theta4; "
    "-pi/2 0 d5 theta5; pi/2 0 0 theta6; 0 0 d7 theta7"
)
# Franka Robotics, Franka Control Interface documentation: Denavit-Hartenberg parameters (Craig), flange at 0.107.
PANDA = (
    "0 0 0.333 theta1; -pi/2 0 0 theta2; pi/2 0 0.316 theta3; pi/2 0.0825 0 theta4; "
    "-pi/2 -0.0825 0.384 theta5; pi/2 0 0 theta6; pi/2 0.088 0.107 theta7"
)
ON_A_RAIL = (
    "pi/2 0 d1 0; pi/2 0 l2 theta2+pi/2; 0 a3 0 theta3; pi/2 0 0 theta4; "
    "-pi/2 0 l5 theta5; pi/2 0 0 theta6; 0 0 l7 theta7"
)
IIWA_ON_A_RAIL = (
    "pi/2 0 d1 0; -pi/2 0 l1 theta2; pi/2 0 0 theta3; pi/2 0 l3 theta4; "
    "-pi/2 0 0 theta5; -pi/2 0 l5 theta6; pi/2 0 0 theta7; 0 0 l7 theta8"
)
FOUR_PARALLEL = (
    "pi/2 0 d1 theta1; 0 a2 0 theta2; 0 a3 0 -theta3; 0 a4 0 theta4; pi/2 0 0 theta5; -pi/2 0 d6 theta6; 0 0 d7 theta7"
)
PUMA = "pi/2 0 0 theta1; 0 a2 0 theta2; -pi/2 a3 d3 theta3; pi/2 0 d4 theta4; -pi/2 0 0 theta5; 0 0 0 theta6"

LOCKED: dict[str, tuple[str, str, dict[str, str | None]]] = {
    "spheres": ("paul", IIWA, {"theta3": None}),
    "spheres_held": ("paul", IIWA, {"theta3": "pi/4"}),
    "spheres_held_plane": ("paul", IIWA, {"theta3": "0"}),
    "spheres_wrist": ("paul", IIWA, {"theta5": "-1.2"}),
    "spheres_first": ("paul", IIWA, {"theta1": None}),
    "panda": ("craig", PANDA, {"theta7": None}),
    "panda_held": ("craig", PANDA, {"theta7": "pi/4"}),
    "panda_held_back": ("craig", PANDA, {"theta7": "-3*pi/4"}),
    "rail": ("paul", ON_A_RAIL, {"d1": None}),
    "rail_held": ("paul", ON_A_RAIL, {"d1": "0.5"}),
    "rail_and_elbow": ("paul", IIWA_ON_A_RAIL, {"d1": None, "theta4": "0.3"}),
    "four_parallel": ("paul", FOUR_PARALLEL, {"theta3": None}),
    "four_parallel_held": ("paul", FOUR_PARALLEL, {"theta3": "0"}),
    "five_left": ("paul", PUMA, {"theta4": None}),
    "screw": ("screw", "elbow_6r_screw", {"theta6": None}),
    "screw_slide": ("screw", "stanford_screw", {"d3": "0.4"}),
    "plane_of_four": ("paul", "0 l1 0 theta1; 0 l2 0 theta2; 0 l3 0 theta3; 0 l4 0 theta4", {"theta4": None}),
}
"""Arms with locked joints: convention, table (a gallery name for screws), locks."""

FRAMED = "framed"
KINDS = (
    "abb_irb6620lx",
    "adept_cobra600",
    "aubo_i5",
    "brooks_pf400",
    "cylindrical_rpp",
    "elbow_6r_screw",
    "elbow_rrr",
    "fanuc_s900w",
    "kinova_j2s6s300",
    "kuka_iiwa",
    "kuka_youbot",
    "nao_left_leg",
    "open_manipulator_x",
    "planar_rr",
    "planar_rrr_craig",
    "planar_rrr_paul",
    "planar_rrr_screw",
    "puma560",
    "scara",
    "scorbot_5r",
    "spherical_wrist",
    "stanford_paul",
    "stanford_screw",
    "ur5",
)
"""Of the gallery one arm of each kind that has a closed form; ``test_generated.py`` takes every robot."""

NAMES = (*KINDS, *SHAPES, *LOCKED, FRAMED)


@cache
def robot(name: str) -> Robot:
    """A gallery robot or a shape."""
    if name == FRAMED:
        return framed()
    if name in LOCKED:
        convention, table, locks = LOCKED[name]
        screw = convention == "screw"
        arm = load(table, name=name) if screw else from_inline(table, convention=convention, name=name)
        return lock(arm, locks)
    return from_inline(SHAPES[name], convention="paul", name=name) if name in SHAPES else load(name)


def framed() -> Robot:
    """A UR5 on a tilted table, with a tool that is turned by 45 degrees and more."""
    draft = tomllib.loads(to_toml(load("ur5")))
    draft["base"] = {"xyz": ["0.1", "h", "0.3"], "rpy": ["0.3", "0.2", "0.1"]}
    draft["tool"] = {"xyz": ["0", "0.05", "0.12"], "rpy": ["pi/2", "0", "deg(45)"]}
    return from_draft({**draft, "name": FRAMED}, where="tests", bindings={})


@cache
def derivation(name: str) -> Derivation:
    """The derivation of a gallery robot or a shape."""
    return derive(robot(name))


@cache
def numpy_module(name: str) -> Any:
    """The generated NumPy module of an arm, without files."""
    module = types.ModuleType(name)
    (source,) = TARGETS["numpy"](build_schedule(derivation(name))).values()
    exec(compile(source, f"{name}.py", "exec"), module.__dict__)
    return module
