"""The equations of a robot for a terminal: its table, forward kinematics, numbered derivation and solutions.

Everything is read from the derivation that the code printers read as well; the names are those of the generated
source.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from kinsym.algebra.convert import tree_of
from kinsym.algebra.tree import Definition, Tree
from kinsym.emit.prose.nominal import IN_DOUBT, LONG, NOMINAL, SINGULAR, TITLE
from kinsym.emit.prose.vocabulary import angle_sums, joint_angles
from kinsym.emit.prose.wording import (
    CONVENTIONS,
    POSE,
    TASKS,
    Loop,
    axis_definitions,
    branch_marks,
    branch_rows,
    branchings,
    counted,
    decimal,
    found_by_sum,
    loops,
    marks_explained,
    one_line,
    origins,
    row_product,
    rule_title,
    shown_items,
    sifting,
)
from kinsym.emit.text.general import general_steps
from kinsym.emit.text.given import assumed, given, held
from kinsym.emit.text.nominal import nominal_arm
from kinsym.emit.text.page import Page
from kinsym.emit.text.singular import singular_poses
from kinsym.inverse.cut import link_letter
from kinsym.inverse.plan import Plan, Step, Window
from kinsym.inverse.state import span
from kinsym.robot.model import Convention, Robot, Vector

if TYPE_CHECKING:
    from kinsym.derivation import Derivation, Nominal
    from kinsym.kinematics.forward import Forward
    from kinsym.kinematics.jacobian import Jacobian


def heading(text: str, rule: str = "-") -> str:
    """A title with a rule of the same length under it."""
    return f"{text}\n{rule * len(text)}"


def _vector(vector: Vector, page: Page) -> str:
    return f"({', '.join(page.formula(tree_of(cell)) for cell in vector)})"


def table(robot: Robot, page: Page | None = None) -> str:
    """The robot's table as its user wrote it, with the home pose of a screw table, base and tool."""
    page = page or Page()
    screw = robot.convention is Convention.SCREW
    craig = robot.convention is Convention.CRAIG
    head = ("s", "s0") if screw else ("alpha_i-1", "a_i-1", "d_i", "theta_i") if craig else ("alpha", "a", "d", "theta")
    rows: list[tuple[str, ...]] = [("i", "joint", *head)]
    for number, joint in enumerate(robot.joints, start=1):
        cells = (joint.alpha, joint.a, joint.d, joint.theta)
        if screw:
            texts = tuple("" if vector is None else _vector(vector, page) for vector in (joint.s, joint.s0))
        else:
            texts = tuple("" if cell is None else page.formula(tree_of(cell)) for cell in cells)
        rows.append((str(number), joint.kind, *texts))
    parts = [page.columns(rows)]
    if robot.home is not None:
        home = robot.home
        vectors = (("u0", home.u0), ("v0", home.v0), ("w0", home.w0), ("q0", home.q0))
        told = [f"{name} = {_vector(vector, page)}" for name, vector in vectors]
        parts.append(page.listed("home pose:", told))
    for name, fixed in (("base", robot.base), ("tool", robot.tool)):
        if fixed is not None:
            cells_of = [[page.formula(tree_of(cell)) for cell in row] for row in fixed]
            parts.append(f"  {name}:\n{page.columns(cells_of, indent=4)}")
    parts += given(robot, page)
    return "\n".join(parts)


def parameters(robot: Robot) -> str:
    """The parameters found in the table; those without a value are required arguments of the generated code."""
    if not robot.parameters:
        return "  none"
    rows = (
        (name, "no value: a required argument of the generated code" if value is None else f"= {decimal(value)}")
        for name, value in robot.parameters.items()
    )
    return Page().columns(rows)


def notation(derivation: Derivation, page: Page | None = None) -> str:
    """What the shorthand of angles and constants stands for."""
    page = page or Page()
    single = [angle for angle in derivation.angles if len(angle.terms) == 1]
    lines = [f"  {a.cosine} = cos({a.name}), {a.sine} = sin({a.name}), and so on" for a in single[:1]]
    if angles := joint_angles(derivation):
        pairs = (f"{item.cosine} = cos({item.name}), {item.sine} = sin({item.name})" for item in angles)
        lines = [f"  {pair}" for pair in pairs]
    for angle, total in angle_sums(derivation):
        lines.append(page.equation(angle.name, f"{page.formula(total)}, {angle.cosine} = cos({angle.name})"))
    lines += [page.equation(item.name, item.value) for item in derivation.constants]
    lines.append("  Atan2(y, x) is the angle of the point (x, y)")
    return "\n".join(lines)


def links(robot: Robot, forward: Forward, page: Page | None = None) -> str:
    """The link transforms as matrices, and the elementary transforms that a row of the table is the product of."""
    page = page or Page()
    parts = [f"  A_i = {product}"] if (product := row_product(robot.convention)) else []
    for link in forward.links:
        cells = [[page.formula(cell) for cell in row] for row in link.matrix[:3]]
        rows = page.columns(cells, indent=0).splitlines()
        head = f"  {link.name} = "
        parts.append("\n".join((head if k == 1 else " " * len(head)) + row for k, row in enumerate(rows)))
    return "\n\n".join(parts)


def forward_kinematics(derivation: Derivation, page: Page | None = None) -> str:
    """The product of the links and its twelve entries, nested by joint; u' where base and tool stand around it."""
    page = page or Page()
    forward, robot = derivation.forward, derivation.robot
    product = " ".join([*(link.name for link in forward.links), *(["[u0 v0 w0 q0]"] if robot.home else [])])
    around = [*(["base"] if robot.base else []), "T'", *(["tool"] if robot.tool else [])]
    framed = len(around) > 1
    head = f"  T' = {product} = [u' v' w' p'], T = {' '.join(around)}" if framed else f"  T = {product} = [u v w p]"
    if derivation.long:
        return f"{head}\n{page.prose(LONG)}"
    prime = "'" if framed else ""
    entries = ((name, forward.pose[row][column]) for column, name_row in enumerate(POSE) for row, name in name_row)
    lines = (page.equation(f"{name[0]}{prime}{name[1:]}", entry) for name, entry in entries)
    return head + "\n\n" + "\n".join(lines)


def jacobian(forward: Forward, jacobian: Jacobian, page: Page | None = None) -> str:
    """Axis directions z_i, axis points o_i and the columns of the geometric Jacobian in the base frame."""
    page = page or Page()
    head = "columns [z_i x (oE - o_i); z_i] of R, [z_i; 0] of P; base frame, velocity first, oE = p"
    parts = [page.prose(head)]
    parts += [page.equation(item.name, item.value) for item in axis_definitions(forward, jacobian)]
    for number, column in enumerate(zip(*jacobian.entries, strict=True), start=1):
        text = f"({', '.join(map(page.formula, column))})"
        parts.append(page.equation(f"J_{number}", text))
    return "\n".join(parts)


def window(loop: Loop, letter: str, page: Page, *, entries: Sequence[Definition] | None = None) -> str:
    """What a pose is made of and those of its entries that are read, or ``entries`` alone."""
    own = loop.window
    name = f"T_{own.left}_{own.right}"
    if loop.whole:
        head = page.prose(f"{name} is T without the constants before the first and after the last joint:")
    else:
        left = [f"{letter}{k}^-1" for k in loop.left]
        right = [f"{letter}{k}^-1" for k in loop.right]
        head = f"  {name} = {' '.join([*left, f'T_{loop.before[0]}_{loop.before[1]}', *right])}"
        if right:
            head += "\n" + page.prose(f"without the constant that follows joint {own.right}:", indent=6)
    shown = own.definitions if entries is None else entries
    return "\n".join([head, *(page.equation(item.name, item.value, indent=6) for item in shown)])


def relation(parts: tuple[Tree, str, Tree], page: Page) -> str:
    """A condition in one line."""
    left, sign, right = parts
    return f"{page.formula(left)} {sign} {page.formula(right)}"


def step_text(step: Step, before: Step | None, page: Page | None = None) -> str:
    """One step with all that a reader needs to repeat it; ``before`` is the one before it."""
    page = page or Page()
    branches = f", {counted(step.branches, 'branch')}" if step.branches > 1 else ""
    lines = [f"  {step.number}. {step.unknown}: {rule_title(step.rule)}{branches}"]
    if step.why:
        lines.append(page.prose(step.why, indent=6))
    for origin in origins(step, before):
        lines.append(page.prose(f"from {origin.text}{':' if origin.equations else ''}", indent=6))
        lines += [page.equation(page.formula(part.lhs), part.rhs, indent=8) for part in origin.equations]
    if step.coefficients:
        lines.append("      with")
        lines += [page.equation(item.name, item.value, indent=8) for item in step.coefficients]
    lines.append("      solution")
    for (name, value), mark in zip(step.solution, branch_marks(step), strict=True):
        note = f"    (branch {mark})" if mark else ""
        lines.append(page.equation(name, value, indent=8) + note)
    if step.condition is not None:
        lines.append(f"      real if {relation(step.condition, page)}")
    if step.degenerate is not None:
        lines.append(f"      free if {relation(step.degenerate, page)}")
    return "\n".join(lines)


def derivation_steps(derivation: Derivation, plan: Plan, page: Page | None = None) -> str:
    """The numbered derivation: what moves to the left, what each step solves, by which rule, and when it fails."""
    page = page or Page()
    robot = derivation.robot
    first, last = span(robot, plan.task)
    letter = link_letter(robot)
    windows = loops(plan, robot)
    head = [page.prose(f"given: {TASKS[plan.task]}, as entries of T = [u v w p]")]
    head += given(robot, page)
    head += held(derivation, page)
    head += assumed(plan, page)
    if (first, last) not in windows:
        head.append(f"  T_{first}_{last} = T")
    head.append(page.prose("T_i_j is the part of T that joints i+1 to j make"))
    if letter != "A":
        head.append(page.prose(f"{letter}i is the motion of joint i with the constant transform to the next joint"))
    parts = ["\n".join(head)]
    names: list[str] = []
    before: Step | None = None
    for item in shown_items(plan):
        if isinstance(item, Definition):
            names.append(page.equation(item.name, item.value))
            continue
        if names:
            parts.append("\n".join(names))
            names = []
        if isinstance(item, Window):
            parts.append(window(windows[item.left, item.right], letter, page))
        else:
            parts.append(step_text(item, before, page))
            before = item
    return "\n\n".join([*parts, "\n".join(names)] if names else parts)


def joint_values(plan: Plan, page: Page | None = None) -> str:
    """The joint variables that are sums of angles found; empty if every step found a joint variable itself."""
    page = page or Page()
    parts = []
    for value in plan.values:
        if found_by_sum(value):
            note = ", taken into (-pi, pi]" if value.wrapped else ""
            parts.append(page.equation(value.variable, page.formula(value.value) + note))
    return "\n".join(parts)


def solutions(derivation: Derivation, plan: Plan, page: Page | None = None) -> str:
    """How many solutions there are, which branch each of them takes and how it is called."""
    page = page or Page()
    branches = derivation.branches
    forks = branchings(plan)
    if not forks:
        lines = ["  one solution"]
    else:
        factors = f" = {' x '.join(str(fork.width) for fork in forks)}" if len(forks) > 1 else ""
        signs, numbers = marks_explained(plan)
        meanings = ["+ is the upper sign or the first value of a step with two branches, - the other"] if signs else []
        meanings += ["1, 2, ... are the real roots of a step with more, the least angle first"] if numbers else []
        lines = [
            f"  at most {counted(plan.maximum, 'solution')}{factors};",
            page.prose(f"{'; '.join(meanings)}:"),
            "",
        ]
        head = ("solution", *(f"step {fork.number}: {fork.unknown}" for fork in forks))
        lines.append(page.columns([head, *((str(number), *marks) for number, marks in branch_rows(plan))]))
        lines += ["", *(page.prose(f"{number}: {name}") for number, name in enumerate(branches.names, start=1))]
        lines += ["", *(page.prose(f"{meaning};") for meaning in branches.meanings[:-1])]
        lines += [page.prose(meaning) for meaning in branches.meanings[-1:]]
    if plan.gate:
        lines.append("")
        lines.append(page.prose(sifting(plan)))
    return "\n".join(lines)


def equations(derivation: Derivation, *, width: int = 80, ascii: bool = False, full: bool = False) -> str:
    """Everything a reader wants to see of a derivation, in the order of the lecture.

    ``full`` adds the link transforms and the Jacobian; ``ascii`` writes ``+-`` for ``±``.
    """
    page = Page(width=width, ascii=ascii)
    robot = derivation.robot
    title = one_line(robot.title) or robot.name
    sections = [
        f"{title}\n{'=' * len(title)}",
        f"{heading(CONVENTIONS[robot.convention])}\n{table(robot, page)}",
        f"{heading('Parameters')}\n{parameters(robot)}",
        f"{heading('Notation')}\n{notation(derivation, page)}",
    ]
    if full or derivation.long:
        sections.append(f"{heading('Link transforms')}\n{links(robot, derivation.forward, page)}")
    sections.append(f"{heading('Forward kinematics')}\n{forward_kinematics(derivation, page)}")
    if full and not derivation.long:
        sections.append(f"{heading('Jacobian')}\n{jacobian(derivation.forward, derivation.jacobian, page)}")
    sections += inverse_sections(derivation, page)
    poses = singular_poses(derivation.singular, derivation.families, page)
    sections.append(f"{heading('Singular poses')}\n{poses}")
    return "\n\n".join(sections) + "\n"


def inverse_sections(derivation: Derivation, page: Page | None = None) -> Iterator[str]:
    """The inverse kinematics: the nominal arm if there is one, the steps and the solutions."""
    page = page or Page()
    if derivation.nominal is not None:
        yield from _beside(derivation.nominal, page)
    if derivation.general is not None:
        title = "Inverse kinematics" if derivation.nominal is None else IN_DOUBT
        yield f"{heading(title)}\n{general_steps(derivation, derivation.general, page)}"
        yield f"{heading('Solutions')}\n  at most {counted(derivation.general.maximum, 'solution')}"
    yield from _closed_form(derivation, "Inverse kinematics", page)


def _closed_form(derivation: Derivation, title: str, page: Page) -> Iterator[str]:
    """The sections of an inverse kinematics in closed form."""
    plan = derivation.plan
    if plan is None:
        return
    yield f"{heading(title)}\n{derivation_steps(derivation, plan, page)}"
    if found := joint_values(plan, page):
        yield f"{heading('Joint values')}\n{found}"
    yield f"{heading('Solutions')}\n{solutions(derivation, plan, page)}"


def _beside(nominal: Nominal, page: Page) -> Iterator[str]:
    """The nominal arm, its closed form and its singular poses."""
    arm = nominal.derivation
    yield f"{heading(TITLE)}\n{nominal_arm(nominal, page)}"
    yield f"{heading('Table of the nominal arm')}\n{table(arm.robot, page)}\n\n{parameters(arm.robot)}"
    yield f"{heading('Its notation')}\n{notation(arm, page)}"
    yield from _closed_form(arm, NOMINAL, page)
    poses = singular_poses(arm.singular, arm.families, page)
    yield f"{heading(SINGULAR)}\n{poses}"
