"""The two printers of a method, and the command that asks for one."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from kinsym.cli import main
from kinsym.command.show import METHODS as OFFERED
from kinsym.emit.latex.method_document import method_document
from kinsym.emit.latex.methods import MethodPage
from kinsym.emit.text.methods import method_text
from kinsym.methods import METHODS
from kinsym.methods.document import Sentence
from kinsym.robot import load

PAGES = [
    ("pieper", "fanuc_s900w"),
    ("screws", "elbow_6r_screw"),
    ("screws_inverse", "stanford_screw"),
    ("algebraic", "puma560"),
    ("geometric", "planar_rr"),
    ("half_angle", "puma560"),
    ("loop_closure", "planar_rrr_paul"),
    ("paul", "scara"),
    ("craig", "planar_rrr_craig"),
    ("zyz", "spherical_wrist"),
    ("decoupled", "fanuc_s900w"),
    ("frames", "planar_rr"),
    ("workspace", "planar_rr"),
]

PREAMBLE = r"""\documentclass[10pt,a4paper]{article}
\usepackage[T1]{fontenc}
\usepackage[margin=25mm]{geometry}
\usepackage{amsmath,array,booktabs}
\setcounter{MaxMatrixCols}{20}
\allowdisplaybreaks
\setlength{\parindent}{0pt}
\emergencystretch=3em
\begin{document}
"""


def test_the_command_offers_every_method() -> None:
    assert tuple(METHODS) == OFFERED
    assert {method for method, _ in PAGES} <= set(METHODS)
    assert set(METHODS) - {method for method, _ in PAGES} == set()


@pytest.mark.parametrize(("method", "name"), PAGES)
def test_every_equation_has_its_number_and_every_reference_its_equation(method: str, name: str) -> None:
    derivation = METHODS[method](load(name))
    numbers = [equation.number for equation in derivation.equations]
    assert numbers == list(range(1, len(numbers) + 1))
    names = {equation.name for equation in derivation.equations}
    for passage in derivation.passages:
        if isinstance(passage, Sentence):
            assert set(passage.references) <= names
    text = method_text(derivation, width=96)
    for number in numbers:
        assert re.search(rf"^  \({number}\) ", text, re.MULTILINE)
    assert "`" not in text
    assert "{" not in text


@pytest.mark.parametrize(("method", "name"), PAGES)
def test_lines_of_text_fit(method: str, name: str) -> None:
    for line in method_text(METHODS[method](load(name)), width=96).splitlines():
        assert len(line) <= 96 or "[" in line


def test_the_same_bytes_twice() -> None:
    once, again = (method_text(METHODS["pieper"](load("fanuc_s900w"))) for _ in range(2))
    assert once == again


def test_a_terminal_without_signs() -> None:
    assert method_text(METHODS["geometric"](load("planar_rr")), ascii=True).isascii()


@pytest.mark.parametrize(("method", "name"), PAGES)
def test_labels_and_references_of_latex(method: str, name: str) -> None:
    """Every equation has a label, its own or that of the line of matrices or of the matrix that it stands in."""
    derivation = METHODS[method](load(name))
    text = method_document(load(name), derivation, "fragment")
    labels = re.findall(r"\\label{([^}]*)}", text)
    assert len(labels) == len(set(labels))
    assert set(re.findall(r"\\eqref{([^}]*)}", text)) <= set(labels)
    page = MethodPage(derivation)
    page.lines()
    assert {page.label(equation.name) for equation in derivation.equations} == set(labels)


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex is not installed")
def test_the_fragments_compile(tmp_path: Path) -> None:
    body = "\n".join(method_document(load(name), METHODS[method](load(name)), "fragment") for method, name in PAGES)
    (tmp_path / "methods.tex").write_text(PREAMBLE + body + "\\end{document}\n", encoding="ascii")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape", "methods.tex"]
    for _ in range(2):
        run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, errors="replace", check=False)
        assert run.returncode == 0, run.stdout[-2000:]
    assert "undefined" not in run.stdout
    widths = [float(points) for points in re.findall(r"Overfull \\hbox \(([0-9.]+)pt", run.stdout)]
    assert max(widths, default=0.0) <= 10.0, run.stdout


def test_show_one_method(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", "fanuc_s900w", "--method", "pieper"]) == 0
    assert "r = 2*(k1*c2 + k2*s2)*a1 + k3" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "status", "message"),
    [
        (("ur5", "--method", "pieper"), 1, "axes 4 and 6 miss by d5"),
        (("ur5", "--method", "euclid"), 2, "--method: 'euclid' is none of loop_closure, craig"),
        (("ur5", "--method", "paul", "--full"), 2, "belong to the usual derivation"),
        (("ur5", "--method", "paul", "--deadline", "1"), 2, "belong to the usual derivation"),
    ],
)
def test_show_refuses(
    arguments: tuple[str, ...], status: int, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["show", *arguments]) == status
    assert message in capsys.readouterr().err
