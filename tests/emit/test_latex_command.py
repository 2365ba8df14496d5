"""``kinsym latex``: what it writes, where, and what it says instead."""

from __future__ import annotations

from pathlib import Path

import pytest

from kinsym.cli import main
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit.latex import document, fragment
from kinsym.emit.latex.method_document import method_document
from kinsym.methods import METHODS
from kinsym.robot import load, lock
from tests.compiled import compile_twice, needs_pdflatex

ROBOT = "planar_rr"
#: The packages that a fragment names in its comment, and nothing else.
OWN = r"""\documentclass[10pt,a4paper]{article}
\usepackage[T1]{fontenc}
\usepackage{amsmath,array,booktabs}
\usepackage[margin=25mm]{geometry}
\setcounter{MaxMatrixCols}{20}
\allowdisplaybreaks
\emergencystretch=3em
\begin{document}
"""


def _iiwa() -> Derivation:
    return derive(lock(load("kuka_iiwa"), {"theta3": None}))


@needs_pdflatex
@pytest.mark.parametrize("name", ["ur5", "fanuc_s900w", "kuka_iiwa", "kinova_jaco"])
def test_long_documents_and_fragments_compile(name: str, tmp_path: Path) -> None:
    """The last has no closed form: the longest equations there are."""
    derivation = _iiwa() if name == "kuka_iiwa" else derive(load(name))
    compile_twice(document(derivation), tmp_path)
    compile_twice(f"{OWN}{fragment(derivation)}\\end{{document}}\n", tmp_path)


@needs_pdflatex
@pytest.mark.parametrize(("name", "method"), [("puma560", "pieper"), ("fanuc_s900w", "decoupled")])
def test_a_method_as_a_document(name: str, method: str, tmp_path: Path) -> None:
    robot = load(name)
    text = method_document(robot, METHODS[method](robot))
    assert "\\begin{cases}" in text
    compile_twice(text, tmp_path)


def test_a_fragment_holds_no_preamble_and_no_command_of_its_own() -> None:
    robot = load("fanuc_s900w")
    for text in (fragment(derive(robot)), method_document(robot, METHODS["pieper"](robot), "fragment")):
        assert "\\documentclass" not in text
        assert "\\begin{document}" not in text
        assert "newcommand" not in text
        assert "kinsym" not in text.partition("\\section")[2]
        assert "%   \\usepackage{amsmath,array,booktabs}" in text


def test_where_it_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["latex", ROBOT]) == 0
    assert capsys.readouterr().out == f"Written\n-------\n  {ROBOT}.tex\n"
    assert (tmp_path / f"{ROBOT}.tex").read_text("ascii") == document(derive(load(ROBOT)))
    assert main(["latex", ROBOT, "--method", "geometric", "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")
    assert "law of cosines" in (tmp_path / f"{ROBOT}_geometric.tex").read_text("ascii")
    assert main(["latex", ROBOT]) == 2
    assert f"{ROBOT}.tex is there already. Name a file with --output" in capsys.readouterr().err
    assert main(["latex", ROBOT, "-o", f"{ROBOT}.tex", "--fragment"]) == 0
    assert (tmp_path / f"{ROBOT}.tex").read_text("ascii") == fragment(derive(load(ROBOT)))


def test_standard_output_holds_the_document_alone(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["latex", ROBOT, "-o", "-", "--quiet"]) == 0
    assert capsys.readouterr() == (document(derive(load(ROBOT))), "")
    # a number that is read as a special value is told beside the document, not in it
    table = tmp_path / "rounded.csv"
    table.write_text("alpha,a,d,theta\n1.5708,0.1,0.2,theta1\n0,0.3,0,theta2\n")
    assert main(["latex", str(table), "--convention", "paul", "-o", "-"]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("% rounded: equations derived by kinsym.")
    assert "1.5708" in err
    assert "1.5708" not in out


@pytest.mark.parametrize(
    ("arguments", "status", "message"),
    [
        (("planar_r",), 2, "Did you mean planar_rr?"),
        (("puma560", "--method", "peiper"), 2, "'peiper' is no method. Did you mean pieper?"),
        (("puma560", "--method", "\x1b[31m"), 2, "is no method"),
        (("ur5", "--method", "pieper", "-o", "-"), 1, "axes 4 and 6 miss by d5"),
        (("ur5", "--method", "paul", "--deadline", "1"), 2, "belongs to the usual derivation"),
        ((), 2, "no table given"),
        (("--lecture", "ur5", "--fragment"), 2, "Leave out TABLE, --fragment"),
        (("--lecture", "--method", "paul"), 2, "Leave out --method"),
        (("--lecture", "--tip-link", "tool0", "--exact"), 2, "Leave out --tip-link, --exact"),
        (("ur5", "-o", "."), 2, "is a folder"),
        (("ur5", "-o", "/proc/nowhere/x.tex"), 2, "could not be written"),
    ],
)
def test_what_it_refuses(
    arguments: tuple[str, ...], status: int, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["latex", *arguments]) == status
    error = capsys.readouterr().err
    assert message in error
    assert "\x1b" not in error
    assert not list(tmp_path.iterdir())
