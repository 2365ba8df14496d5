"""Two derivations written out by hand, so that the printers are tested without the search.

The planar 2R is the lecture's motivating example (section 3.1); the arm is the lecture's Fanuc S-900W (section
3.6): its tables and equations are those of the lecture, the plan is shaped like the one a search would find.
"""

from __future__ import annotations

import ast
from fractions import Fraction
from itertools import product
from types import SimpleNamespace
from typing import Any

import sympy as sp

from kinsym.algebra.tree import ONE, Call, Definition, Num, Pi, PlusMinus, Pow, Quot, Tree, add, mul, negated, sub
from kinsym.algebra.tree import Sym as Name
from kinsym.inverse.branches import Branches
from kinsym.inverse.plan import Equation, Item, JointValue, Plan, Step, Window
from kinsym.kinematics.angles import interval
from kinsym.kinematics.singular import SingularSet
from kinsym.robot.model import Convention, Joint, Robot, Task


def tree(text: str) -> Tree:
    """The tree of a formula in Python's notation; ``a @ b`` stands for a ± b."""
    return _tree(ast.parse(text.strip(), mode="eval").body)


def _tree(node: ast.expr) -> Tree:
    match node:
        case ast.Constant(value):
            return Num(Fraction(str(value)))
        case ast.Name("pi"):
            return Pi()
        case ast.Name(name):
            return Name(name)
        case ast.UnaryOp(ast.USub(), operand):
            return negated(_tree(operand))
        case ast.BinOp(left, ast.Add(), right):
            return add(_tree(left), _tree(right))
        case ast.BinOp(left, ast.Sub(), right):
            return sub(_tree(left), _tree(right))
        case ast.BinOp(left, ast.Mult(), right):
            return mul(_tree(left), _tree(right))
        case ast.BinOp(left, ast.Div(), right):
            return Quot(_tree(left), _tree(right))
        case ast.BinOp(left, ast.MatMult(), right):
            return PlusMinus(_tree(left), _tree(right))
        case ast.BinOp(left, ast.Pow(), ast.Constant(exponent)):
            return Pow(_tree(left), int(exponent))
        case ast.Call(ast.Name(function), arguments):
            return Call(function, tuple(_tree(argument) for argument in arguments))
    raise ValueError(ast.dump(node))


def matrix(*rows: str) -> tuple[tuple[Tree, ...], ...]:
    """A matrix whose rows are written with commas."""
    return tuple(tuple(tree(cell) for cell in row.split(",")) for row in rows)


def _define(**values: str) -> tuple[Definition, ...]:
    return tuple(Definition(name=name, value=tree(value)) for name, value in values.items())


def _equations(source: str, *pairs: str) -> tuple[Equation, ...]:
    split = (pair.split(" = ") for pair in pairs)
    return tuple(Equation(lhs=tree(left), rhs=tree(right), source=source) for left, right in split)


def _relation(text: str) -> tuple[Tree, str, Tree] | None:
    if not text:
        return None
    left, relation, right = text.split(" ; ")
    return tree(left), relation, tree(right)


def step(
    number: int,
    unknown: str,
    rule: str,
    equations: tuple[Equation, ...],
    solution: dict[str, str],
    *,
    branches: int = 1,
    coefficients: tuple[Definition, ...] = (),
    condition: str = "",
    degenerate: str = "",
    why: str = "",
) -> Step:
    """A step with everything a reader sees; what only the kernels read is left empty."""
    return Step(
        number=number,
        unknown=unknown,
        rule=rule,
        equations=equations,
        coefficients=coefficients,
        inputs={},
        outputs=(),
        branches=branches,
        reference=(),
        solution=tuple((name, tree(value)) for name, value in solution.items()),
        condition=_relation(condition),
        degenerate=_relation(degenerate),
        why=why,
    )


def _paul(table: str, parameters: dict[str, Fraction | None], name: str, title: str, task: Task) -> Robot:
    joints = []
    for row in table.split(";"):
        alpha, a, d, theta = (sp.sympify(cell.strip(), locals={"pi": sp.pi}) for cell in row.split(","))
        variable = str(theta)
        joints.append(Joint(kind="R", variable=variable, alpha=alpha, a=a, d=d, theta=theta))
    return Robot(
        name=name,
        title=title,
        convention=Convention.PAUL,
        joints=tuple(joints),
        parameters=parameters,
        task=task,
    )


def _derivation(
    robot: Robot,
    *,
    groups: tuple[tuple[int, ...], ...],
    links: tuple[Any, ...],
    pose: Any,
    jacobian: Any,
    plan: Plan,
) -> Any:
    links = tuple(SimpleNamespace(name=f"A{k}", matrix=link) for k, link in enumerate(links, start=1))
    angles = {}
    for group, joints in enumerate(groups):
        signed = tuple((f"theta{k}", 1) for k in joints)
        for low in range(len(joints)):
            for high in range(low + 1, len(joints) + 1):
                digits = {f"theta{k}": str(k) for k in joints}
                angles[group, low, high] = interval(group, low, signed[low:high], digits)
    return SimpleNamespace(
        robot=robot,
        chain=SimpleNamespace(angles=angles),
        solved=SimpleNamespace(angles=angles),
        forward=SimpleNamespace(links=links, pose=pose),
        jacobian=jacobian,
        plan=plan,
        general=None,
        nominal=None,
        long=False,
        constants=(),
        singular=SingularSet(task=plan.task, square=True, constant=ONE, conditions=(), exhaustive=True, split=True),
        families=(),
        held=(),
        branches=_branches(plan),
        angles=tuple(angles.values()),
    )


def _branches(plan: Plan) -> Branches:
    """Names by unknown, as an arm has them that no geometry tells apart."""
    forks = [[f"{step.unknown} {sign}" for sign in "+-"] for step in plan.steps if step.branches > 1]
    return Branches(names=tuple(", ".join(words) for words in product(*forks)), meanings=("+ and - are signs",))


def planar_2r(title: str = "Planar RR arm") -> Any:
    """The two-link arm of the lecture's motivating example: position task, two solutions."""
    robot = _paul("0, l1, 0, theta1; 0, l2, 0, theta2", {"l1": None, "l2": None}, "planar_rr", title, Task.POSITION)
    items: tuple[Item, ...] = (
        step(
            1,
            "theta2",
            "triangle",
            _equations("column p of T_0_2", "p_x = l1*c1 + l2*c12", "p_y = l1*s1 + l2*s12"),
            {"c2": "kappa1/(2*l1*l2)", "theta2": "0 @ atan2(sqrt(1 - c2**2), c2)"},
            branches=2,
            coefficients=_define(kappa1="p_x**2 + p_y**2 - l1**2 - l2**2"),
            condition="abs(kappa1) ; <= ; 2*l1*l2",
            why="the squares of both equations add up to an equation in theta2 alone",
        ),
        step(
            2,
            "theta1",
            "direction",
            _equations("column p of T_0_2", "mu1*c1 - nu1*s1 = p_x", "nu1*c1 + mu1*s1 = p_y"),
            {"theta1": "atan2(p_y*mu1 - p_x*nu1, p_x*mu1 + p_y*nu1)"},
            coefficients=_define(mu1="l1 + l2*c2", nu1="l2*s2"),
            degenerate="p_x**2 + p_y**2 ; = ; 0",
            why="theta2 is known, so both equations are linear in c1 and s1",
        ),
    )
    plan = Plan(
        task=Task.POSITION,
        items=items,
        values=(
            JointValue(variable="theta1", value=tree("atan2(s1, c1)"), wrapped=False),
            JointValue(variable="theta2", value=tree("atan2(s2, c2)"), wrapped=False),
        ),
        maximum=2,
        gate=False,
        size=tree("l1 + l2"),
    )
    jacobian = SimpleNamespace(
        definitions=_define(o2_x="l1*c1", o2_y="l1*s1"),
        entries=matrix("-p_y, o2_y - p_y", "p_x, p_x - o2_x", "0, 0", "0, 0", "0, 0", "1, 1"),
    )
    links = tuple(
        matrix(f"c{k}, -s{k}, 0, l{k}*c{k}", f"s{k}, c{k}, 0, l{k}*s{k}", "0, 0, 1, 0", "0, 0, 0, 1") for k in (1, 2)
    )
    pose = matrix("c12, -s12, 0, l1*c1 + l2*c12", "s12, c12, 0, l1*s1 + l2*s12", "0, 0, 1, 0", "0, 0, 0, 1")
    return _derivation(robot, groups=((1, 2),), links=links, pose=pose, jacobian=jacobian, plan=plan)


def fanuc(title: str = "Fanuc S-900W") -> Any:
    """The lecture's Fanuc S-900W: six joints, three branching steps, eight solutions."""
    robot = _paul(
        "pi/2, a1, 0, theta1; 0, a2, 0, theta2; pi/2, a3, 0, theta3; "
        "-pi/2, 0, d4, theta4; pi/2, 0, 0, theta5; 0, 0, d6, theta6",
        {"a1": Fraction("0.3"), "a2": Fraction("0.9"), "a3": Fraction("0.18"), "d4": Fraction("1.6"), "d6": None},
        "fanuc_s900w",
        title,
        Task.POSE,
    )
    wrist = _define(p06_x="p_x - d6*w_x", p06_y="p_y - d6*w_y", p06_z="p_z - d6*w_z")
    shoulder = _define(p16_x="p06_x*c1 + p06_y*s1 - a1")
    hand = {
        f"{column}36_{row}": text
        for column in "uvw"
        for row, text in {
            "x": f"c23*(c1*{column}_x + s1*{column}_y) + s23*{column}_z",
            "y": f"s1*{column}_x - c1*{column}_y",
            "z": f"s23*(c1*{column}_x + s1*{column}_y) - c23*{column}_z",
        }.items()
    }
    items: tuple[Item, ...] = (
        Window(left=0, right=6, definitions=wrist),
        step(
            1,
            "theta1",
            "homogeneous",
            _equations("row z, column p of A1^-1 T_0_6 = A2 A3 A4 A5 A6", "p06_x*s1 - p06_y*c1 = 0"),
            {"theta1": "atan2(p06_y, p06_x)"},
            branches=2,
            degenerate="p06_x**2 + p06_y**2 ; = ; 0",
            why="one equation in theta1 alone: the wrist point lies in the plane of links 2 and 3",
        ),
        Window(left=1, right=6, definitions=shoulder),
        step(
            2,
            "theta3",
            "linear",
            _equations("squares of the column p of T_1_6", "kappa2*c3 + kappa1*s3 = kappa3"),
            {"theta3": "atan2(kappa1, kappa2) @ atan2(sqrt(kappa1**2 + kappa2**2 - kappa3**2), kappa3)"},
            branches=2,
            coefficients=_define(
                kappa1="2*a2*d4", kappa2="2*a2*a3", kappa3="p16_x**2 + p06_z**2 - a2**2 - a3**2 - d4**2"
            ),
            condition="kappa3**2 ; <= ; kappa1**2 + kappa2**2",
            degenerate="kappa1**2 + kappa2**2 ; = ; 0",
            why="the distance of the wrist point from axis 2 does not depend on theta2",
        ),
        step(
            3,
            "theta2",
            "quotient",
            _equations("rows x and y, column p of T_1_6", "mu1*c2 + nu1*s2 = p16_x", "mu2*c2 + nu2*s2 = p06_z"),
            {"theta2": "atan2(mu1*p06_z - nu2*p16_x, mu1*p16_x + nu2*p06_z)"},
            coefficients=_define(mu1="a2 + a3*c3 + d4*s3", nu1="d4*c3 - a3*s3", mu2="-nu1", nu2="mu1"),
            why="theta3 is known, so both equations are linear in c2 and s2",
        ),
        Definition(name="c23", value=tree("c2*c3 - s2*s3")),
        Definition(name="s23", value=tree("s2*c3 + c2*s3")),
        Window(left=3, right=6, definitions=_define(**hand)),
        step(
            4,
            "theta5",
            "linear",
            _equations("row z, column w of T_3_6 = A4 A5 A6", "c5 = w36_z"),
            {"theta5": "0 @ atan2(sqrt(1 - w36_z**2), w36_z)"},
            branches=2,
            condition="w36_z**2 ; <= ; 1",
            why="one equation in theta5 alone",
        ),
        step(
            5,
            "theta4",
            "quotient",
            _equations("rows x and y, column w of T_3_6 = A4 A5 A6", "s5*c4 = w36_x", "s5*s4 = w36_y"),
            {"theta4": "atan2(w36_y/s5, w36_x/s5)"},
            degenerate="s5 ; = ; 0",
            why="theta5 is known",
        ),
        step(
            6,
            "theta6",
            "direct",
            _equations(
                "row y, columns u and v of A4^-1 T_3_6 = A5 A6", "s6 = u36_y*c4 - u36_x*s4", "c6 = v36_y*c4 - v36_x*s4"
            ),
            {"theta6": "atan2(u36_y*c4 - u36_x*s4, v36_y*c4 - v36_x*s4)"},
            why="these two entries hold no theta5, so nothing is divided by s5",
        ),
    )
    values = tuple(
        JointValue(variable=f"theta{k}", value=tree(f"atan2(s{k}, c{k})"), wrapped=False) for k in range(1, 7)
    )
    plan = Plan(
        task=Task.POSE, items=items, values=values, maximum=8, gate=False, size=tree("abs(a1) + abs(a2) + abs(d4)")
    )
    links = (
        matrix("c1, 0, s1, a1*c1", "s1, 0, -c1, a1*s1", "0, 1, 0, 0", "0, 0, 0, 1"),
        matrix("c2, -s2, 0, a2*c2", "s2, c2, 0, a2*s2", "0, 0, 1, 0", "0, 0, 0, 1"),
        matrix("c3, 0, s3, a3*c3", "s3, 0, -c3, a3*s3", "0, 1, 0, 0", "0, 0, 0, 1"),
        matrix("c4, 0, -s4, 0", "s4, 0, c4, 0", "0, -1, 0, d4", "0, 0, 0, 1"),
        matrix("c5, 0, s5, 0", "s5, 0, -c5, 0", "0, 1, 0, 0", "0, 0, 0, 1"),
        matrix("c6, -s6, 0, 0", "s6, c6, 0, 0", "0, 0, 1, d6", "0, 0, 0, 1"),
    )
    outer = {"x": ("c1", "s1", "-", "+"), "y": ("s1", "c1", "+", "-")}
    rows = []
    for c, s, first, second in outer.values():
        u = f"{c}*(c23*(c4*c5*c6 - s4*s6) - s23*s5*c6) {second} {s}*(s4*c5*c6 + c4*s6)"
        v = f"{c}*(-c23*(c4*c5*s6 + s4*c6) + s23*s5*s6) {first} {s}*(s4*c5*s6 - c4*c6)"
        w = f"{c}*(c23*c4*s5 + s23*c5) {second} {s}*s4*s5"
        p = f"{c}*(d6*(c23*c4*s5 + s23*c5) + d4*s23 + a3*c23 + a2*c2 + a1) {second} d6*{s}*s4*s5"
        rows.append(", ".join((u, v, w, p)))
    pose = matrix(
        *rows,
        "s23*(c4*c5*c6 - s4*s6) + c23*s5*c6, -s23*(c4*c5*s6 + s4*c6) - c23*s5*s6, s23*c4*s5 - c23*c5, "
        "d6*(s23*c4*s5 - c23*c5) - d4*c23 + a3*s23 + a2*s2",
        "0, 0, 0, 1",
    )
    definitions = _define(
        z2_x="s1", z2_y="-c1", o2_x="a1*c1", o2_y="a1*s1", o3_x="c1*(a2*c2 + a1)", o3_y="s1*(a2*c2 + a1)", o3_z="a2*s2"
    )
    column = "z2_y*(p_z - o{0}_z), -z2_x*(p_z - o{0}_z), z2_x*(p_y - o{0}_y) - z2_y*(p_x - o{0}_x), z2_x, z2_y, 0"
    columns = ["-p_y, p_x, 0, 0, 0, 1"] + [column.format(k) for k in (2, 3)] + [column.format(3)] * 3
    entries = tuple(zip(*(matrix(text)[0] for text in columns), strict=True))
    return _derivation(
        robot,
        groups=((1,), (2, 3), (4,), (5,), (6,)),
        links=links,
        pose=pose,
        jacobian=SimpleNamespace(definitions=definitions, entries=entries),
        plan=plan,
    )
