"""Schedules written out by hand, so that the printers of code are tested without the search.

The planar 2R is the lecture's motivating example (section 3.1). The six-joint arm is J. J. Craig's Puma 560
(Introduction to Robotics, sections 3.7 and 4.7: the table, with the link lengths of Armstrong, Khatib, Burdick 1986)
with the inverse kinematics of kinsym's own rules. The polar arm adds a prismatic joint, a gate and no parameters.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import prod

from kinsym.emit.schedule import Assign, JointName, Note, Parameter, Schedule, Solve, Statement, StraightLine
from kinsym.inverse.plan import Definition, Step
from kinsym.robot.model import Task
from tests.emit.sample import tree

TAU = Fraction(1, 2**46)


def define(text: str) -> tuple[Definition, ...]:
    """Definitions, one ``name = formula`` a line."""
    pairs = (line.split(" = ") for line in text.strip().splitlines())
    return tuple(Definition(name=name.strip(), value=tree(value)) for name, value in pairs)


def line(definitions: str, outputs: str) -> StraightLine:
    """A straight line from its definitions and its rows of comma-separated outputs."""
    cells = [cell for row in outputs.strip().splitlines() for cell in row.split(",")]
    return StraightLine(definitions=define(definitions), outputs=tuple(map(tree, cells)))


def solve(level: int, rule: str, outputs: str, branches: int, reference: str = "", **inputs: str) -> Solve:
    """A call of a kernel; ``reference`` names joints, a minus before a name takes it off."""
    signs = tuple((name.lstrip("-"), -1 if name.startswith("-") else 1) for name in reference.split())
    step = Step(
        number=1,
        unknown=outputs.split(maxsplit=1)[0],
        rule=rule,
        equations=(),
        coefficients=(),
        inputs={name: tree(value) for name, value in inputs.items()},
        outputs=tuple(outputs.split()),
        branches=branches,
        reference=signs,
        solution=(),
        condition=None,
        degenerate=None,
        why="",
    )
    return Solve(level=level, step=step)


def assign(level: int, text: str) -> list[Statement]:
    """Assignments, one ``name = formula`` a line."""
    return [Assign(level=level, name=item.name, value=item.value) for item in define(text)]


def schedule(
    name: str,
    *,
    joints: str,
    parameters: dict[str, str | None],
    forward: StraightLine,
    jacobian: StraightLine,
    inverse: list[Statement],
    task: Task,
    size: str,
    title: str = "",
    table: tuple[str, ...] = (),
    constants: str = "",
    gate: bool = False,
) -> Schedule:
    """A schedule; a joint whose name begins with d is prismatic."""
    depth = sum(isinstance(item, Solve) and item.step.branches > 1 for item in inverse)
    inverse = [
        replace(item, step=replace(item.step, number=number)) if isinstance(item, Solve) else item
        for number, item in enumerate(inverse, start=1)
    ]
    return Schedule(
        name=name,
        title=title,
        table=table,
        digest="0" * 16,
        joints=tuple(JointName(name=joint, kind="P" if joint[0] == "d" else "R") for joint in joints.split()),
        parameters=tuple(
            Parameter(name=key, value=None if value is None else Fraction(value)) for key, value in parameters.items()
        ),
        constants=define(constants) if constants else (),
        forward=forward,
        jacobian=jacobian,
        inverse=tuple(inverse),
        solution=tuple(joints.split()),
        depth=depth,
        maximum=prod(item.step.branches for item in inverse if isinstance(item, Solve)),
        task=task,
        gate=gate,
        size=tree(size),
        tau=TAU,
    )


def planar_2r(*, a2: str | None = "0.5", title: str = "Planar 2R") -> Schedule:
    """The lecture's planar 2R, asked for a position; ``a2=None`` leaves a length to the caller."""
    cosines = """
        c1 = cos(theta1)
        s1 = sin(theta1)
        c12 = cos(theta1 + theta2)
        s12 = sin(theta1 + theta2)
        """
    return schedule(
        "planar",
        title=title,
        table=("alpha  a   d  theta", "0      a1  0  theta1", "0      a2  0  theta2"),
        joints="theta1 theta2",
        parameters={"a1": "0.7", "a2": a2},
        forward=line(cosines, "c12, -s12, 0, a1*c1 + a2*c12\n s12, c12, 0, a1*s1 + a2*s12\n 0, 0, 1, 0"),
        jacobian=line(cosines, "-a1*s1 - a2*s12, -a2*s12\n a1*c1 + a2*c12, a2*c12\n 0, 0\n 0, 0\n 0, 0\n 1, 1"),
        inverse=[
            Note(level=0, text="(1) theta2, two links: p_x^2 + p_y^2 = a1^2 + a2^2 + 2 a1 a2 c2"),
            solve(0, "triangle", "k_2 w_2 along_2", 2, x="p_x", y="p_y", l1="a1", l2="a2", t="tau*size"),
            *assign(1, "theta2 = atan2(w_2/a2, k_2/a2)"),
            Note(level=1, text="(2) theta1, a direction: p_x = c1 (a1 + k_2) - s1 w_2, p_y = s1 (a1 + k_2) + c1 w_2"),
            solve(1, "direction", "c1 s1", 1, "theta1", x="p_x", y="p_y", along="along_2", across="w_2", t="tau*size"),
            *assign(1, "theta1 = atan2(s1, c1)"),
        ],
        task=Task.POSITION,
        size="abs(a1) + abs(a2)",
    )


def polar() -> Schedule:
    """A turning joint and a sliding one in a plane: p = d2 (c1, s1, 0); a position is reached only if p_z = 0."""
    cosines = "c1 = cos(theta1)\ns1 = sin(theta1)"
    return schedule(
        "polar",
        title="Polar arm",
        joints="theta1 d2",
        parameters={},
        forward=line(cosines, "c1, -s1, 0, c1*d2\n s1, c1, 0, d2*s1\n 0, 0, 1, 0"),
        jacobian=line(cosines, "-d2*s1, c1\n c1*d2, s1\n 0, 0\n 0, 0\n 0, 0\n 1, 0"),
        inverse=[
            Note(level=0, text="(1) d2, quadratic: d2^2 = p_x^2 + p_y^2"),
            solve(0, "quadratic", "d2", 2, b="0", c="-p_x**2 - p_y**2", t="tau*size**2"),
            Note(level=1, text="(2) theta1, a quotient: d2 c1 = p_x, d2 s1 = p_y"),
            solve(1, "quotient", "c1 s1", 1, "theta1", x="p_x", y="p_y", d="d2", t="tau*size"),
            *assign(1, "theta1 = atan2(s1, c1)"),
        ],
        task=Task.POSITION,
        size="1",
        gate=True,
    )


PUMA_COSINES = "\n".join(
    f"c{k} = cos({a})\ns{k} = sin({a})"
    for k, a in (("1", "theta1"), ("2", "theta2"), ("23", "theta2 + theta3"), ("4", "theta4"), ("5", "theta5"))
)
PUMA_FORWARD = (
    PUMA_COSINES
    + """
        c6 = cos(theta6)
        s6 = sin(theta6)
        m_x = c4*c5*c6 - s4*s6
        m_z = -s4*c5*c6 - c4*s6
        n_x = -c4*c5*s6 - s4*c6
        n_z = s4*c5*s6 - c4*c6
        u_h = c23*m_x - s23*s5*c6
        v_h = c23*n_x + s23*s5*s6
        w_h = -c23*c4*s5 - s23*c5
        h = a2*c2 + a3*c23 - d4*s23
        """
)
PUMA_POSE = """
    c1*u_h - s1*m_z, c1*v_h - s1*n_z, c1*w_h - s1*s4*s5, c1*h - d3*s1
    s1*u_h + c1*m_z, s1*v_h + c1*n_z, s1*w_h + c1*s4*s5, s1*h + d3*c1
    -s23*m_x - c23*s5*c6, -s23*n_x + c23*s5*s6, s23*c4*s5 - c23*c5, -a2*s2 - a3*s23 - d4*c23
    """
PUMA_JACOBIAN = """
    -s1*h - d3*c1, c1*r, c1*(r + a2*s2), 0, 0, 0
    c1*h - d3*s1, s1*r, s1*(r + a2*s2), 0, 0, 0
    0, -h, a2*c2 - h, 0, 0, 0
    0, -s1, -s1, -c1*s23, c1*c23*s4 - s1*c4, -c1*(c23*c4*s5 + s23*c5) - s1*s4*s5
    0, c1, c1, -s1*s23, s1*c23*s4 + c1*c4, -s1*(c23*c4*s5 + s23*c5) + c1*s4*s5
    1, 0, 0, -c23, -s23*s4, s23*c4*s5 - c23*c5
    """


def puma() -> Schedule:
    """The Puma 560 with its shoulder offset, Craig's table."""
    return schedule(
        "puma",
        title="Unimation Puma 560",
        table=(
            "alpha   a   d   theta",
            "0       0   0   theta1",
            "-pi/2   0   0   theta2",
            "0       a2  d3  theta3",
            "-pi/2   a3  d4  theta4",
            "pi/2    0   0   theta5",
            "-pi/2   0   0   theta6",
        ),
        joints="theta1 theta2 theta3 theta4 theta5 theta6",
        parameters={"a2": "0.4318", "a3": "0.0203", "d3": "0.1501", "d4": "0.4318"},
        constants="l3 = sqrt(a3**2 + d4**2)",
        forward=line(PUMA_FORWARD, PUMA_POSE),
        jacobian=line(PUMA_COSINES + "\nh = a2*c2 + a3*c23 - d4*s23\nr = -a2*s2 - a3*s23 - d4*c23", PUMA_JACOBIAN),
        inverse=[
            Note(level=0, text="(1) theta1, one linear equation: p_y c1 - p_x s1 = d3"),
            solve(0, "linear", "c1 s1", 2, "theta1", a="p_y", b="-p_x", e="d3", t="tau*size"),
            *assign(1, "theta1 = atan2(s1, c1)\nmu1 = c1*p_x + s1*p_y"),
            Note(level=1, text="(2) theta3, two links: mu1^2 + p_z^2 = a2^2 + l3^2 + 2 a2 (a3 c3 - d4 s3)"),
            solve(1, "triangle", "k_2 w_2 along_2", 2, x="mu1", y="-p_z", l1="a2", l2="l3", t="tau*size"),
            solve(2, "direction", "c3 s3", 1, "theta3", x="k_2", y="w_2", along="a3", across="d4", t="tau*size"),
            *assign(2, "theta3 = atan2(s3, c3)"),
            Note(level=2, text="(3) theta2, a direction: mu1 = c2 (a2 + k_2) - s2 w_2, -p_z = s2 (a2 + k_2) + c2 w_2"),
            solve(2, "direction", "c2 s2", 1, "theta2", x="mu1", y="-p_z", along="along_2", across="w_2", t="tau*size"),
            *assign(2, "theta2 = atan2(s2, c2)\nc23 = c2*c3 - s2*s3\ns23 = s2*c3 + c2*s3"),
            *(
                item
                for column in "uvw"
                for item in assign(
                    2,
                    f"""p36_{column}x = c23*(c1*{column}_x + s1*{column}_y) - s23*{column}_z
                    p36_{column}z = c1*{column}_y - s1*{column}_x""",
                )
            ),
            *assign(2, "p36_wy = -s23*(c1*w_x + s1*w_y) - c23*w_z\nunread = c23*s23"),
            Note(level=2, text="(4) theta4, a homogeneous equation: p36_wz c4 + p36_wx s4 = 0"),
            solve(2, "homogeneous", "c4 s4", 2, "theta4", a="p36_wz", b="p36_wx", t="tau"),
            *assign(3, "theta4 = atan2(s4, c4)"),
            Note(level=3, text="(5) theta5, direct: c5 = p36_wy, s5 = s4 p36_wz - c4 p36_wx"),
            solve(3, "direct", "c5 s5", 1, c="p36_wy", s="s4*p36_wz - c4*p36_wx"),
            *assign(3, "theta5 = atan2(s5, c5)"),
            Note(level=3, text="(6) theta6, direct: s6 = -s4 p36_ux - c4 p36_uz, c6 = -s4 p36_vx - c4 p36_vz"),
            solve(3, "direct", "c6 s6", 1, c="-s4*p36_vx - c4*p36_vz", s="-s4*p36_ux - c4*p36_uz"),
            *assign(3, "theta6 = atan2(s6, c6)"),
        ],
        task=Task.POSE,
        size="abs(a2) + abs(a3) + abs(d3) + abs(d4)",
    )


def every_kernel() -> Schedule:
    """No robot: a schedule that calls every kernel once, for its helpers."""
    cosines = "c1 = cos(theta1)\ns1 = sin(theta1)"
    reference = "theta1 -theta2"
    return schedule(
        "every",
        joints="theta1 theta2 d3",
        parameters={"a": "1", "b": None},
        forward=line(cosines, "c1, -s1, 0, a\n s1, c1, 0, b\n 0, 0, 1, 0"),
        jacobian=line(cosines, "c1, 0, sign(a)\n" + "\n".join(["0, 0, 0"] * 5)),
        inverse=[
            solve(0, "homogeneous", "c1 s1", 2, reference, a="p_x", b="p_y", t="tau"),
            solve(
                1,
                "homogeneous2",
                "c2 s2",
                2,
                reference,
                a="p_x",
                b="p_y",
                t="tau*size",
                a_alt="w_x",
                b_alt="w_y",
                t_alt="tau",
            ),
            solve(2, "linear", "c3 s3", 2, reference, a="p_x", b="p_y", e="a", t="tau"),
            solve(3, "linear_pole", "c10 s10", 2, a="a", b="0", p="a", k="b", x="w_x", y="w_y", z="w_z", t="tau"),
            solve(4, "triangle", "k_4 w_4 along_4", 2, x="p_x", y="p_y", l1="a", l2="b", t="tau"),
            solve(5, "quadratic", "d5", 2, b="p_x", c="p_y", t="tau"),
            solve(
                6,
                "quartic",
                "c4 s4",
                4,
                reference,
                **dict(zip(("xc", "xs", "x", "yc", "ys", "y"), ("p_x", "0", "a", "p_y", "b", "d5"), strict=True)),
                **dict(zip(("kc", "ks", "k", "lc", "ls", "l"), ("1", "p_z", "0", "w_x", "0", "0"), strict=True)),
                t="tau*size",
                **{
                    f"{name}2": "1"
                    for name in ("xc", "xs", "x", "yc", "ys", "y", "kc", "ks", "k", "lc", "ls", "l", "t")
                },
            ),
            solve(7, "quotient", "c6 s6", 1, reference, x="p_x", y="p_y", d="d5", t="tau"),
            solve(7, "quotient_length", "d7", 1, "d3", n="p_x", d="p_y", t="tau"),
            solve(7, "direction", "c8 s8", 1, reference, x="p_x", y="p_y", along="k_4", across="w_4", t="tau"),
            solve(7, "direct", "c9 s9", 1, c="c6", s="s6*s8"),
            solve(7, "length", "d3", 1, d="d7 + d5"),
            *assign(7, "theta1 = wrap(atan2(s1, c1) + atan2(s2, c2))\ntheta2 = atan2(s3*s4, c3*c9*c10)"),
        ],
        task=Task.POSITION,
        size="hypot(a, b)",
    )
