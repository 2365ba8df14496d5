"""The command line as a user meets it: exit status, messages, files."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from kinsym import __version__
from kinsym.check.report import FAILED, Check
from kinsym.cli import main
from kinsym.command.derive import TARGETS
from kinsym.command.options import CONVENTIONS, TASKS
from kinsym.command.rendering import FILES
from kinsym.robot import gallery
from kinsym.robot.model import Convention, Task

PLANAR = "planar_rr"


class Run:
    """One call of ``kinsym`` in this process, in a folder of its own."""

    def __init__(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self.folder, self._capsys = folder, capsys
        self.out = self.err = ""

    def __call__(self, *arguments: str) -> int:
        status = main(arguments)
        self.out, self.err = self._capsys.readouterr()
        assert "Traceback" not in self.err
        return status


@pytest.fixture
def kinsym(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """The command line in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return Run(tmp_path, capsys)


def test_choices_are_those_of_the_model() -> None:
    """The parser repeats the names of the model so as not to load it."""
    assert set(TASKS) == {task.value for task in Task}
    assert set(CONVENTIONS) == {convention.value for convention in Convention}
    assert set(TARGETS) == set(FILES)


def test_without_checks_nothing_loads_numpy(tmp_path: Path) -> None:
    """It takes a tenth of the time of a derivation, and only what is checked needs numbers."""
    code = (
        "import sys; from kinsym.cli import main; "
        f"assert main(['derive', '{PLANAR}', '--no-check', '--quiet', '-o', {str(tmp_path / PLANAR)!r}]) == 0; "
        "assert 'numpy' not in sys.modules; assert 'jinja2' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(__file__).resolve().parent.parent)


def test_derive_writes_five_files_and_says_so(kinsym: Run) -> None:
    """Progress on standard error; equations, checks and files on standard output; status 0."""
    assert kinsym("derive", PLANAR) == 0
    names = [PLANAR + suffix for suffix in (".py", ".c", ".h", ".tex", ".report.json")]
    assert sorted(os.listdir(kinsym.folder / PLANAR)) == sorted(names)
    assert "theta2" in kinsym.out
    assert "Checks" in kinsym.out
    assert all(f"{PLANAR}/{name}" in kinsym.out for name in names)
    assert f"deriving {PLANAR}" in kinsym.err
    report = json.loads((kinsym.folder / PLANAR / f"{PLANAR}.report.json").read_text())
    assert report["checked"] == "passed"
    assert report["figures"]["poses"] >= 1000


def test_operations_are_told(kinsym: Run) -> None:
    """The same counts on the terminal, in the report and in the head of each file; a search for roots has none."""
    assert kinsym("derive", PLANAR, "--no-check") == 0
    told = kinsym.out.partition("Operations of the C\n-------------------\n")[2].partition("\n\n")[0].splitlines()
    assert [line.split()[0] for line in told] == ["fk", "ik", "jacobian"]
    # p = l1 (c1, s1) + l2 (c12, s12): four products, two sums, and theta1 + theta2 once in each expression
    assert told[0] == "  fk        4 + -, 4 *, 2 sincos"
    for suffix in (".py", ".c", ".h"):
        text = (kinsym.folder / PLANAR / (PLANAR + suffix)).read_text()
        assert told[0] in text
        assert told[2] in text
    report = json.loads((kinsym.folder / PLANAR / f"{PLANAR}.report.json").read_text())
    assert set(report["operations"]) == {"forward", "inverse", "jacobian"}
    assert (report["operations"]["forward"]["multiplications"], report["operations"]["forward"]["sincos"]) == (4, 2)
    assert kinsym("derive", "fanuc_crx10ial", "--no-check", "-o", "crx") == 0
    assert "  ik        as many as its search for roots takes\n" in kinsym.out


@pytest.mark.usefixtures("few_poses")
def test_same_bytes_twice(kinsym: Run) -> None:
    """Two runs write the same files, the report included."""
    assert kinsym("derive", PLANAR, "-o", "one") == kinsym("derive", PLANAR, "-o", "two") == 0
    for path in (kinsym.folder / "one").iterdir():
        assert path.read_bytes() == (kinsym.folder / "two" / path.name).read_bytes()


def test_targets_and_quiet(kinsym: Run) -> None:
    """Only the languages asked for; nothing printed."""
    assert kinsym("derive", PLANAR, "--target", "latex", "--target", "numpy", "--quiet", "--no-check", "-o", "x") == 0
    assert sorted(os.listdir(kinsym.folder / "x")) == sorted(PLANAR + s for s in (".py", ".tex", ".report.json"))
    assert kinsym.out == kinsym.err == ""
    assert json.loads((kinsym.folder / "x" / f"{PLANAR}.report.json").read_text())["checked"] == "not run"


def test_table_on_the_command_line(kinsym: Run) -> None:
    """A name of one's own, a parameter folded in."""
    rows = "0 l1 0 theta1; 0 l2 0 theta2"
    options = ("--convention", "paul", "--name", "mine", "--task", "position", "--bind", "l1=0.5", "--no-check")
    assert kinsym("derive", "--dh", rows, *options) == 0
    source = (kinsym.folder / "mine" / "mine.py").read_text()
    assert "l2" in source
    assert "l1" not in source.split("def fk")[1].split("def ")[0].replace("theta", "")


def test_show_prints_and_writes_nothing(kinsym: Run) -> None:
    """The equations alone."""
    assert kinsym("show", PLANAR) == 0
    assert "theta2" in kinsym.out
    assert os.listdir(kinsym.folder) == []


def test_robots(kinsym: Run) -> None:
    """The whole gallery, a line each."""
    assert kinsym("robots") == 0
    assert [line.split()[0] for line in kinsym.out.splitlines()[1:]] == list(gallery())


@pytest.mark.usefixtures("few_poses")
def test_check_passes_tells_edits_and_finds_faults(kinsym: Run) -> None:
    """Untouched files pass; a comment is told and passes; a sign flipped by hand fails in each language."""
    assert kinsym("derive", PLANAR, "-o", "x", "--quiet") == 0
    assert kinsym("check", "x") == 0
    assert "not what kinsym would write" not in kinsym.err
    folder = kinsym.folder / "x"
    report = (folder / f"{PLANAR}.report.json").read_text()
    for suffix in (".py", ".c"):
        path = folder / (PLANAR + suffix)
        text = path.read_text()
        path.write_text(text + ("# by hand\n" if suffix == ".py" else "/* by hand */\n"))
        assert kinsym("check", "x") == 0
        assert f"{path.name} is not what kinsym would write today: it was changed" in kinsym.err
        flipped = text.replace("sin(theta1)", "sin(-theta1)", 1)
        assert flipped != text
        path.write_text(flipped)
        assert kinsym("check", "x", "--quiet") == 1
        assert "checks failed" in kinsym.err
        path.write_text("not source\n")
        assert kinsym("check", "x", "--quiet") == 1
        path.unlink()
        assert kinsym("check", "x", "--quiet") == 1
        assert "is missing" in kinsym.err
        path.write_text(text)
        (folder / f"{PLANAR}.report.json").write_text(report)


@pytest.mark.parametrize(
    "content", ["", "{}", "[1]", '{"table": ["x"], "files": {}}', '{"table": 3}', "\udcff", "[" * 9999]
)
def test_check_of_what_is_no_report(kinsym: Run, content: str) -> None:
    """A clear message, status 2."""
    Path("x.report.json").write_bytes(content.encode("utf-8", "surrogateescape"))
    assert kinsym("check", ".") == 2
    assert "x.report.json" in kinsym.err


def test_check_without_a_report(kinsym: Run) -> None:
    """No folder, and a folder that kinsym has not written."""
    assert kinsym("check", "nowhere") == 2
    assert "nowhere is no folder" in kinsym.err
    assert kinsym("check", ".") == 2
    assert "holds no *.report.json" in kinsym.err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["dervie", PLANAR], "derive"),
        ([PLANAR], f"Did you mean: kinsym derive {PLANAR}?"),
        (["derive", "planar_rrr_pual"], "planar_rrr_paul"),
        (["derive"], "no table given"),
        (["derive", PLANAR, "--dh", "0 a 0 theta1"], "both a table and --dh"),
        (["derive", "--dh", "0 a 0 theta1"], "convention"),
        (["derive", PLANAR, "--bind", "l1"], "is not NAME=VALUE"),
        (["derive", PLANAR, "--bind", "l1=1", "--bind", "l1=2"], "bound twice"),
        (["derive", PLANAR, "--bind", "l3=1"], "l3"),
        (["derive", PLANAR, "--bind", "l1=__import__('os')"], "--bind l1"),
        (["derive", PLANAR, "--name", "../x"], "../x"),
        (["derive", PLANAR, "--target", "fortran"], "fortran"),
        (["derive", PLANAR, "--task", "dance"], "dance"),
        (["derive", PLANAR, "-o", "file"], "is a file"),
        (["derive", PLANAR, "-o", "file/x"], "is a file"),
        (["derive", "nothing.toml"], "nothing.toml"),
        (["derive", PLANAR, "--frob"], "--frob"),
        (["derive", "kuka_iiwa", "--lock", "theat3"], "--lock: kuka_iiwa has no joint 'theat3'. Did you mean theta3?"),
        (["derive", "kuka_iiwa", "--lock", "theta3=nan"], "--lock theta3: NaN and infinity are not numbers"),
        (["derive", "kuka_iiwa", "--lock", "theta3=30"], "30 radians are more than a turn. Write deg(30)"),
        (["derive", "kuka_iiwa", "--lock", "theta3="], "'theta3=' is neither JOINT nor JOINT=VALUE"),
        (["derive", "kuka_iiwa", "--lock", "theta3", "--lock", "theta3=1"], "theta3 is locked twice"),
        (["show", PLANAR, "--lock", "theta1", "--lock", "theta2"], "every joint is locked"),
        ([], "COMMAND"),
    ],
)
def test_wrong_input(kinsym: Run, arguments: list[str], message: str) -> None:
    """One message that names the place, status 2, nothing written."""
    Path("file").write_text("mine")
    assert kinsym(*arguments) == 2
    assert message in kinsym.err
    assert os.listdir(kinsym.folder) == ["file"]
    assert Path("file").read_text() == "mine"


@pytest.mark.usefixtures("few_poses")
def test_locks_of_the_command_line(kinsym: Run) -> None:
    """They stand in place of the file's; the report keeps them, so that the check needs no option."""
    assert kinsym("derive", "kuka_iiwa", "--lock", "theta5=-30deg", "--target", "numpy", "--quiet", "-o", "x") == 0
    source = (kinsym.folder / "x" / "kuka_iiwa.py").read_text()
    assert 'LOCKED = {"theta5": -np.pi / 6.0}' in source
    assert "def ik(T, *, reference=None, d1=0.36" in source
    assert kinsym("check", "x") == 0
    assert kinsym("show", "kuka_iiwa", "--lock", "theta6") == 0
    assert "theta6 is given" in kinsym.out
    assert "theta3 is given" not in kinsym.out


def test_an_arm_with_a_joint_to_spare(kinsym: Run) -> None:
    """Status 1, nothing written, and the option that helps."""
    rows = (
        "pi/2 0 d1 theta1; 0 a2 0 theta2; 0 a3 0 theta3; 0 a4 0 theta4; "
        "pi/2 0 0 theta5; -pi/2 0 d6 theta6; 0 0 d7 theta7"
    )
    assert kinsym("derive", "--dh", rows, "--convention", "paul") == 1
    assert "Add for example --lock theta4" in kinsym.err
    assert os.listdir(kinsym.folder) == []
    assert kinsym("show", "--dh", rows, "--convention", "paul", "--lock", "theta4") == 0


def test_version_and_help(kinsym: Run) -> None:
    """Both are answers, not errors."""
    assert kinsym("--version") == 0
    assert kinsym.out == f"kinsym {__version__}\n"
    assert kinsym("--help") == 0
    assert "derive" in kinsym.out


def test_help_loads_nothing_heavy() -> None:
    """``kinsym --help`` under 0.3 s: neither SymPy nor NumPy nor Jinja is imported."""
    code = (
        "import sys; from kinsym.cli import main; main(['--help']); "
        "print([name for name in ('sympy', 'numpy', 'jinja2') if name in sys.modules])"
    )
    before = os.times()
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert out.splitlines()[-1] == "[]"
    after = os.times()  # of the processor, which other programs do not lengthen as they do the time of day
    assert after.children_user + after.children_system - before.children_user - before.children_system < 1.0


def test_a_closed_pipe_does_not_stop_the_work(tmp_path: Path) -> None:
    """``kinsym derive ... | head -1`` still writes its files, without a traceback."""
    command = f"{sys.executable} -m kinsym derive {PLANAR} --no-check -o {tmp_path}/x 2>{tmp_path}/err | head -1"
    subprocess.run(["bash", "-c", command], check=True, capture_output=True)
    assert "Traceback" not in (tmp_path / "err").read_text()
    assert len(os.listdir(tmp_path / "x")) == 5


def test_interrupt_is_quiet(tmp_path: Path) -> None:
    """Ctrl-C: status 130, no traceback, nothing left."""
    process = subprocess.Popen(
        [sys.executable, "-m", "kinsym", "derive", "puma560", "-o", str(tmp_path / "x")],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stderr is not None
    process.stderr.readline()
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "Traceback" not in err
    assert os.listdir(tmp_path) == []


def test_a_failed_check_is_told_and_written(kinsym: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """The files are there to be looked at, the report says failed, and so does the exit status."""
    from kinsym.check import compare

    failed = compare.Findings(
        checks=(Check(law="a law", subject="C", status=FAILED, tried=3, failed=1, note="the reason"),),
        figures={"poses": 3, "poses_by_kind": {}, "solutions_at_random_poses": {}},
        measured={"cases": {}},
    )
    monkeypatch.setattr(compare, "compare", lambda *_: failed)
    assert kinsym("derive", PLANAR) == 1
    assert "C: a law" in kinsym.err
    assert "the reason" in kinsym.out
    assert json.loads((kinsym.folder / PLANAR / f"{PLANAR}.report.json").read_text())["checked"] == "failed"


@pytest.mark.usefixtures("few_poses")
def test_without_a_compiler(kinsym: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """The C is written, the report says that it was not compiled, and the rest is checked."""
    monkeypatch.setattr("kinsym.check.sources.find_compiler", lambda: None)
    assert kinsym("derive", PLANAR) == 0
    assert "no C compiler was found" in kinsym.err
    report = json.loads((kinsym.folder / PLANAR / f"{PLANAR}.report.json").read_text())
    assert [check["law"] for check in report["checks"] if check["status"] == "not run"] == [
        "compiles without a warning"
    ]
    assert f"{PLANAR}.c" in report["files"]


def test_no_closed_form(kinsym: Run) -> None:
    """Seven axes that neither meet nor are parallel: status 1, what blocks it, nothing written."""
    rows = "; ".join(f"pi/2 a{i} d{i} theta{i}" for i in range(1, 8))
    assert kinsym("derive", "--dh", rows, "--convention", "paul", "--name", "general", "--task", "pose") == 1
    assert "7 joints are more than" in kinsym.err
    assert os.listdir(kinsym.folder) == []
