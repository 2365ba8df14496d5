"""The LaTeX document: safe whatever the user writes, the same bytes every time, and TeX sets it within its margins."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from kinsym.algebra.tree import Sym
from kinsym.emit.latex import document
from kinsym.emit.latex.formula import LatexPrinter
from kinsym.emit.latex.layout import PAGE, Relation, aligned
from kinsym.emit.latex.measure import width
from kinsym.emit.latex.names import Names
from kinsym.emit.latex.sentences import escape, prose
from kinsym.emit.latex.tables import table_of
from kinsym.robot import load
from kinsym.robot.files import from_draft
from tests.emit.sample import fanuc, planar_2r, tree

HOSTILE = "50% of $x_1$ & #2 {~^} \\input{/etc/passwd}\n\\end{document} é Ω 漢字 \x07 <|> -- ``quotes'' " + "long" * 60
needs_pdflatex = pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex is not installed")


def long_names() -> Any:
    """The planar arm with lengths of forty letters, and one that only looks like another."""
    arm = planar_2r()
    names = {"l1": "length_of_the_upper_arm_of_this_robot_aa", "l2": "lengthofthelowerarmofthisrobotabcdefghij"}

    def renamed(tree: Any) -> Any:
        if isinstance(tree, Sym):
            return Sym(names.get(tree.name, tree.name))
        if isinstance(tree, tuple):
            return tuple(renamed(part) for part in tree)
        if hasattr(tree, "__dataclass_fields__") and not isinstance(tree, type):
            return replace(tree, **{field: renamed(getattr(tree, field)) for field in tree.__dataclass_fields__})
        if isinstance(tree, sp.Expr):
            return tree.subs({sp.Symbol(old): sp.Symbol(new) for old, new in names.items()})
        return tree

    arm.plan = renamed(arm.plan)
    arm.forward.pose = renamed(arm.forward.pose)
    for link in arm.forward.links:
        link.matrix = renamed(link.matrix)
    arm.jacobian.definitions = renamed(arm.jacobian.definitions)
    joints = tuple(replace(joint, a=renamed(joint.a)) for joint in arm.robot.joints)
    parameters = dict.fromkeys(names.values()) | {"a1": Fraction(1, 3), "a_1": Fraction(3, 16)}
    arm.robot = replace(arm.robot, joints=joints, parameters=parameters)
    return arm


SAMPLES = {
    "planar_2r": planar_2r,
    "fanuc": fanuc,
    "hostile": lambda: planar_2r(HOSTILE),
    "long_names": long_names,
}


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        # lecture, Stanford arm, r11
        (
            "c1*(c2*(c4*c5*c6 - s4*s6) - s2*s5*c6)",
            r"c_{1} \bigl[c_{2} (c_{4} c_{5} c_{6} - s_{4} s_{6}) - s_{2} s_{5} c_{6}\bigr]",
        ),
        ("0 @ atan2(s5, c5)", r"\pm \operatorname{Atan2}(s_{5}, c_{5})"),
        ("sqrt(1 - w36_z**2)", r"\sqrt{1 - {}^{3}w_{6,z}^{2}}"),
        ("c1*p16_x", r"c_{1} \, {}^{1}p_{6,x}"),
        ("c12m4*a2", "c_{12-4} a_{2}"),
        ("0.5*pi - pi", r"\pi/2 - \pi"),
        ("cos(pi/6)", r"\cos(\pi/6)"),
        ("-kappa1/(2*l1)", r"-\frac{\kappa_{1}}{2 l_{1}}"),
        ("abs(a + b)", r"\lvert a + b \rvert"),
        ("(a + b)**2", "(a + b)^{2}"),
    ],
)
def test_formulas(source: str, expected: str) -> None:
    assert LatexPrinter(Names([]))(tree(source)) == expected


def test_two_names_never_look_alike() -> None:
    everything = ["a1", "a_1", "a__1", "theta23", "theta_23", "p16_x", "L_arm", "Larm", "c1", "calpha1", "c_alpha1"]
    names = Names(everything)
    assert len({names[name] for name in everything}) == len(everything)


def test_words_of_a_sentence_become_mathematics_only_where_they_are_names() -> None:
    names = Names(["theta3", "a", "of", "s5"])
    text = prose("a row of A1^-1 T_0_6 holds theta3 alone, 50% of s5^2; column p", names)
    assert text == (r"a row of $A_{1}^{-1} \, {}^{0}T_{6}$ holds $\theta_{3}$ alone, 50\% of $s_{5}^{2}$; column $p$")


@given(st.text())
def test_escaped_text_holds_no_command_of_the_user(text: str) -> None:
    safe = escape(text)
    assert safe.isascii()
    assert "\n" not in safe
    known = r"\\(?:text[a-z]+\{\}|hspace\{0pt\}|dots\{\}|(?:ss|o|O|ae|AE|oe|OE|l|L)\{\}|[`'^~=.\"urHvck]\{|[{}$&#%_])"
    rest = re.sub(known + r"|\$\\(?:pm|times)\$", "", safe)
    assert "\\" not in rest
    assert not set(rest) & set("$&#%_^~")


@pytest.mark.parametrize("sample", SAMPLES)
def test_documents_are_well_formed(sample: str) -> None:
    text = document(SAMPLES[sample]())
    assert text.isascii()
    assert text.endswith("\\end{document}\n")
    body = re.sub(r"\\[{}]", "", text)
    assert body.count("{") == body.count("}")
    opened: list[str] = []
    for kind, environment in re.findall(r"\\(begin|end)\{([^}]*)\}", text):
        if kind == "begin":
            opened.append(environment)
        else:
            assert opened.pop() == environment
    assert not opened
    assert "\n\n\n" not in text
    assert not re.search(r"[ \t]$", text, re.MULTILINE)


def test_every_step_and_every_solution_is_in_the_document() -> None:
    text = document(fanuc())
    steps = re.findall(r"\\subsection\*\{Step (\d): \\boldmath\$\\theta_\{(\d)\}\$\}", text)
    assert steps == [("1", "1"), ("2", "3"), ("3", "2"), ("4", "5"), ("5", "4"), ("6", "6")]
    assert text.count("There is a real solution if") == 2
    assert len(re.findall(r"^\$\d\$ & \$[+-]\$", text, re.MULTILINE)) == 8


def test_same_bytes_whatever_the_hash_seed() -> None:
    code = (
        "import hashlib; from tests.emit.sample import fanuc; from kinsym.emit.latex import document;"
        "from kinsym.emit.text import equations;"
        "print(hashlib.sha256((document(fanuc()) + equations(fanuc(), full=True)).encode()).hexdigest())"
    )
    root = Path(__file__).resolve().parents[2]
    digests = {
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": str(root)},
            cwd=root,
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in ("0", "1", "4242")
    }
    assert len(digests) == 1


def test_lines_of_equations_fit_the_page() -> None:
    printer = LatexPrinter(Names([]))
    long = " + ".join(f"a{k}*c{k}*(b{k} - s{k}*(p16_x + kappa{k}))" for k in range(1, 30))
    for left in ("u_x", "a1*c1 + a2*c2 + a3*c3 + a4*c4 + a5*c5 + a6*c6"):
        blocks = aligned([Relation(left=printer(tree(left)), right=printer(tree(long)))])
        lines = [line for rows in blocks for row in rows for line in row]
        assert len(lines) > 4
        assert all(width(line.replace("&", "")) <= PAGE for line in lines)


def test_a_table_that_is_too_wide_is_told_cell_by_cell() -> None:
    """Numbers that were worked out elsewhere and stand in the cells as formulas."""
    total = " + ".join(f"b{k}" for k in range(1, 25))
    joints = [
        {"type": "R", "alpha": "0", "a": total, "d": f"({total})/2", "theta": f"theta{k} + deg(30)"} for k in (1, 2)
    ]
    robot = from_draft({"name": "arm", "convention": "paul", "joints": joints}, where="test")
    table = table_of(robot, LatexPrinter(Names([*robot.parameters, *robot.variables])))
    lines = [line for rows in table.blocks for row in rows for line in row]
    assert [left for line in lines if (left := line.partition("&")[0].strip())][:3] == [
        rf"\text{{row 1: }} {name}" for name in (r"\alpha_i", "a_i", "d_i")
    ]
    assert all(width(line.replace("&", "")) <= PAGE for line in lines)
    short = table_of(load("planar_rr"), LatexPrinter(Names(["l1", "l2", "theta1", "theta2"])))
    assert (short.blocks, short.small) == ((), False)


@needs_pdflatex
@pytest.mark.parametrize("sample", SAMPLES)
def test_documents_compile_within_their_margins(sample: str, tmp_path: Path) -> None:
    (tmp_path / "robot.tex").write_text(document(SAMPLES[sample]()), encoding="ascii")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape", "robot.tex"]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False, timeout=120)
    log = (tmp_path / "robot.log").read_text(encoding="latin-1").replace("\n", "")
    assert result.returncode == 0, log[-2000:]
    assert "undefined" not in log
    overfull = [float(points) for points in re.findall(r"Overfull \\hbox \(([\d.]+)pt too wide", log)]
    assert max(overfull, default=0.0) <= 10.0
