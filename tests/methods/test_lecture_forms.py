"""The methods print what the lecture prints (H. D. Taghirad, Robotics: Mechanics & Control, chapter 3)."""

from __future__ import annotations

import pytest

from kinsym.emit.text.formula import TextPrinter
from kinsym.methods import METHODS
from kinsym.methods.document import Equation, Factor, Matrix, Product
from kinsym.methods.half_angle import general
from kinsym.robot import from_inline, load
from kinsym.robot.model import Robot

PIEPER = (
    "0 0 0 theta1; alpha1 a1 d2 theta2; alpha2 a2 d3 theta3; alpha3 a3 d4 theta4; alpha4 0 0 theta5; alpha5 0 0 theta6"
)
"""The general arm of slides 56 to 58, Craig's convention; the zeros of row 1 are what the printed shape of P needs."""


def written(equation: Equation) -> tuple[str, str]:
    return tuple(side_text(side) for side in (equation.left, equation.right))


def side_text(side: object) -> str:
    if isinstance(side, Product):
        return " ".join(side_text(f) if isinstance(f, Matrix) else name(f) for f in side.factors)
    if isinstance(side, Matrix):
        return "; ".join(", ".join(map(TextPrinter(), row)) for row in side.rows)
    return TextPrinter()(side)


def name(factor: Factor) -> str:
    return f"{factor.name}^{factor.mark}" if factor.mark else factor.name


def robot_of(text: str) -> Robot:
    return from_inline(PIEPER, convention="craig", name="pieper_craig") if text == "pieper" else load(text)


SYMBOLIC_PIEPER = {
    "point": ("P_0_O4", "T_0_1 T_1_2 T_2_3 a3; -salpha3*d4; calpha3*d4; 1"),
    "point.g": ("P_0_O4", "c1*g1 - s1*g2; s1*g1 + c1*g2; g3; 1"),
    "f1": ("f1", "a3*c3 + salpha3*d4*s3 + a2"),
    "f2": ("f2", "calpha2*a3*s3 - calpha2*salpha3*d4*c3 - salpha2*calpha3*d4 - salpha2*d3"),
    "f3": ("f3", "salpha2*a3*s3 - salpha2*salpha3*d4*c3 + calpha2*calpha3*d4 + calpha2*d3"),
    "g1": ("g1", "f1*c2 - f2*s2 + a1"),
    "g2": ("g2", "calpha1*f2*c2 + calpha1*f1*s2 - salpha1*f3 - salpha1*d2"),
    "g3": ("g3", "salpha1*f2*c2 + salpha1*f1*s2 + calpha1*f3 + calpha1*d2"),
    "r.g": ("r", "g1^2 + g2^2 + g3^2"),
    "r.f": ("r", "f1^2 + f2^2 + f3^2 + 2*d2*f3 + a1^2 + d2^2 + 2*a1*(f1*c2 - f2*s2)"),
    "k1": ("k1", "f1"),
    "k2": ("k2", "-f2"),
    "k3": ("k3", "f1^2 + f2^2 + f3^2 + 2*d2*f3 + a1^2 + d2^2"),
    "k4": ("k4", "calpha1*f3 + calpha1*d2"),
    "r": ("r", "2*(k1*c2 + k2*s2)*a1 + k3"),
    "z": ("z", "(k1*s2 - k2*c2)*salpha1 + k4"),
    "case3": ("(r - k3)^2/(4*a1^2) + (z - k4)^2/salpha1^2", "k1^2 + k2^2"),
}

ELBOW = {
    "p.loop.1": ("A1^-1 p", "A2 A3 A4 p0"),
    "A2A3A4": (
        "A2 A3 A4",
        "c234, 0, -s234, a2*c2 + a3*c23 - c234*(a2 + a3); 0, 1, 0, 0; "
        "s234, 0, c234, a2*s2 + a3*s23 - s234*(a2 + a3); 0, 0, 0, 1",
    ),
    "p.1.x": ("c1*p_x + s1*p_y", "a2*c2 + a3*c23 + a4*c234"),
    "p.1.y": ("c1*p_y - s1*p_x", "0"),
    "p.1.z": ("p_z", "a2*s2 + a3*s23 + a4*s234"),
    "theta1": ("theta1", "Atan2(p_y, p_x)"),
    "w.loop.1": ("R1^T w", "R2 R3 R4 R5 w0"),
    "w.1.x": ("c1*w_x + s1*w_y", "c234*c5"),
    "w.1.y": ("c1*w_y - s1*w_x", "s5"),
    "theta5": ("theta5", "asin(c1*w_y - s1*w_x)"),
    "theta5.other": ("theta5", "pi - asin(c1*w_y - s1*w_x)"),
    "theta234": ("theta234", "Atan2(w_z/c5, (c1*w_x + s1*w_y)/c5)"),
    "k1": ("k1", "c1*p_x + s1*p_y - a4*c234"),
    "k2": ("k2", "p_z - a4*s234"),
    "theta3.squares": ("a2^2 + a3^2 + 2*a2*a3*c3", "k1^2 + k2^2"),
    "theta3": ("theta3", "±acos((k1^2 + k2^2 - a2^2 - a3^2)/(2*a2*a3))"),
    "theta2.c": ("c2", "((a3*c3 + a2)*k1 + a3*s3*k2)/(2*a2*a3*c3 + a2^2 + a3^2)"),
    "theta4": ("theta4", "theta234 - theta2 - theta3"),
    "u.4.x": ("c1*c234*u_x + s1*c234*u_y + s234*u_z", "s5*s6"),
    "u.4.y": ("c1*u_y - s1*u_x", "-c5*s6"),
    "theta6.s": ("s6", "s5*(c1*c234*u_x + s1*c234*u_y + s234*u_z) - c5*(c1*u_y - s1*u_x)"),
    "theta6": ("theta6", "Atan2(s6, c6)"),
}

STANFORD = {
    "p_x": ("p_x", "q_x - h*w_x"),
    "p": ("p", "A1 A2 A3 p0"),
    "p.0.x": ("p_x", "g*c1 - d3*s1*c2"),
    "p.0.z": ("p_z", "d3*s2"),
    "p.squared": ("p_x^2 + p_y^2 + p_z^2", "d3^2 + g^2"),
    "d3": ("d3", "±sqrt(p_x^2 + p_y^2 + p_z^2 - g^2)"),
    "theta2": ("theta2", "asin(p_z/d3)"),
    "theta1.c": ("c1", "(g*p_x + d3*c2*p_y)/(d3^2*c2^2 + g^2)"),
    "theta1.s": ("s1", "(g*p_y - d3*c2*p_x)/(d3^2*c2^2 + g^2)"),
    "w_in3_y": ("w_in3_y", "c2*(c1*w_y - s1*w_x) + s2*w_z"),
    "w_in3_z": ("w_in3_z", "c2*w_z + s2*(s1*w_x - c1*w_y)"),
    "w.3.x": ("w_in3_x", "-c4*s5"),
    "theta5": ("theta5", "±acos(w_in3_y)"),
    "theta4": ("theta4", "Atan2(w_in3_z/s5, -w_in3_x/s5)"),
    "u.3.x": ("u_in3_x", "c4*c5*c6 - s4*s6"),
    "theta6": ("theta6", "Atan2(-s4*u_in3_x - c4*u_in3_z, u_in3_y/s5)"),
}

PLANAR = {
    "fk.x": ("a1*c1 + a2*c12 + a3*c123", "x_E"),
    "fk.phi": ("phi", "theta1 + theta2 + theta3"),
    "p_x.from_E": ("p_x", "x_E - a3*cos(phi)"),
    "p_y.joints": ("p_y", "a1*s1 + a2*s12"),
    "theta2.squares": ("a1^2 + a2^2 + 2*a1*a2*c2", "p_x^2 + p_y^2"),
    "kappa": ("kappa", "(p_x^2 + p_y^2 - a1^2 - a2^2)/(2*a1*a2)"),
    "theta2": ("theta2", "±acos(kappa)"),
    "theta1.row.x": ("(a2*c2 + a1)*c1 - a2*s2*s1", "p_x"),
    "Delta": ("Delta", "2*a1*a2*c2 + a1^2 + a2^2"),
    "theta1.c": ("c1", "((a2*c2 + a1)*p_x + a2*s2*p_y)/Delta"),
    "theta1": ("theta1", "Atan2(s1, c1)"),
    "theta3": ("theta3", "phi - theta1 - theta2"),
}

GEOMETRIC = {
    "cosines": ("x^2 + y^2", "l1^2 + l2^2 - 2*l1*l2*cos(pi - theta2)"),
    "supplement": ("cos(pi - theta2)", "-c2"),
    "theta2.c": ("c2", "(x^2 + y^2 - l1^2 - l2^2)/(2*l1*l2)"),
    "exists.near": ("abs(l1 - l2)", "sqrt(x^2 + y^2)"),
    "exists.far": ("sqrt(x^2 + y^2)", "l1 + l2"),
}

LOOP = {
    "loop.vector": ("l1_vec + l2_vec + l3_vec", "chi_vec"),
    "loop.theta": ("Theta_E", "theta1 + theta2 + theta3"),
    "loop.y": ("l1*sin(theta1) + l2*sin(theta1 + theta2) + l3*sin(theta1 + theta2 + theta3)", "y_E"),
    "x": ("l1*c1 + l2*c12 + l3*c123", "x_E"),
    "c12": ("c12", "cos(theta1 + theta2)"),
}

SCREWS = {
    "A2": ("A2", "c2, -s2, 0, a1*(1 - c2); s2, c2, 0, -a1*s2; 0, 0, 1, 0; 0, 0, 0, 1"),
    "A1A2A3": (
        "A1 A2 A3",
        "c123, -s123, 0, a1*c1 + a2*c12 - c123*(a1 + a2); s123, c123, 0, a1*s1 + a2*s12 - s123*(a1 + a2); "
        "0, 0, 1, 0; 0, 0, 0, 1",
    ),
    "q": ("q", "A1 A2 A3 q0"),
    "q_x": ("q_x", "a1*c1 + a2*c12 + a3*c123"),
}

CASES = [
    *(("pieper", "pieper", *item) for item in SYMBOLIC_PIEPER.items()),
    *(("screws_inverse", "elbow_6r_screw", *item) for item in ELBOW.items()),
    *(("screws_inverse", "stanford_screw", *item) for item in STANFORD.items()),
    *(("algebraic", "planar_rrr_paul", *item) for item in PLANAR.items()),
    *(("geometric", "planar_rrr_craig", *item) for item in GEOMETRIC.items()),
    *(("loop_closure", "planar_rrr_craig", *item) for item in LOOP.items()),
    *(("screws", "planar_rrr_screw", *item) for item in SCREWS.items()),
]


@pytest.mark.parametrize(("method", "robot", "equation", "form"), CASES)
def test_the_printed_form(method: str, robot: str, equation: str, form: tuple[str, str]) -> None:
    assert written(METHODS[method](robot_of(robot)).equation(equation)) == form


def test_the_general_reduction_to_a_polynomial() -> None:
    forms = [written(equation) for equation in general().equations]
    assert forms[0] == ("a*cos(theta) + b*sin(theta)", "c")
    assert ("a*(1 - u_1^2) + 2*b*u_1", "c*(1 + u_1^2)") in forms
    assert ("(a + c)*u_1^2 - 2*b*u_1 + c - a", "0") in forms
    assert forms[-1] == ("theta", "2*atan((b ± sqrt(a^2 + b^2 - c^2))/(a + c))")


def test_the_general_screw_displacement() -> None:
    text = side_text(METHODS["screws"](load("stanford_screw")).equation("A").right)
    first = text.split("; ")[0].split(", ")
    assert first[:3] == [
        "s_x^2*v(theta) + cos(theta)",
        "s_x*s_y*v(theta) - s_z*sin(theta)",
        "s_x*s_z*v(theta) + s_y*sin(theta)",
    ]
    assert first[3].startswith("d*s_x - so_x*(s_x^2 - 1)*v(theta) - so_y*(")


@pytest.mark.parametrize(
    ("robot", "case"),
    [("puma560", "case1"), ("fanuc_s900w", "case3"), ("flat", "case2")],
)
def test_pieper_takes_the_case_of_the_table(robot: str, case: str) -> None:
    flat = "0 0 0 theta1; 0 a1 d2 theta2; deg(40) a2 d3 theta3; pi/2 a3 d4 theta4; -pi/2 0 0 theta5; pi/2 0 0 theta6"
    arm = from_inline(flat, convention="craig", name="flat") if robot == "flat" else load(robot)
    names = {equation.name for equation in METHODS["pieper"](arm).equations}
    assert names & {"case1", "case2", "case3"} == {case}


def test_pieper_degree_four_only_where_neither_vanishes() -> None:
    branches = {name: METHODS["pieper"](load(name)).solutions[0].branches for name in ("puma560", "fanuc_s900w")}
    assert branches == {"puma560": 2, "fanuc_s900w": 4}
