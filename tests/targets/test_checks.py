"""What derive and check do with the files of the targets cpp and ikfast."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from kinsym.cli import main
from tests.targets.built import needs_compiler

pytestmark = needs_compiler
LAWS = {
    "C++": ("compiles without a warning", "FK(IK(T)) = T for every solution", "ik and ik_batch agree"),
    "ikfast": (
        "compiles without a warning",
        "ComputeIk finds the known joint vector",
        "ComputeIk refuses what is no pose",
    ),
}


def outcome(folder: Path) -> dict[tuple[str, str], str]:
    """The status of every check by subject and law."""
    checks = json.loads((folder / "gudel_fp1.report.json").read_text(encoding="utf-8"))["checks"]
    return {(check["subject"], check["law"]): check["status"] for check in checks}


@pytest.mark.usefixtures("few_poses")
def test_files_that_are_written_are_checked_and_checked_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """And a change of either file is found: a forward kinematics that is off, a joint that is told wrong."""
    arguments = ["derive", "gudel_fp1", "--target", "cpp", "--target", "ikfast", "-o", str(tmp_path), "--quiet"]
    assert main(arguments) == 0, capsys.readouterr().err
    statuses = outcome(tmp_path)
    for subject, laws in LAWS.items():
        assert [statuses[subject, law] for law in laws] == ["passed"] * len(laws)
    header, solver = tmp_path / "gudel_fp1.hpp", tmp_path / "gudel_fp1_ikfast.cpp"
    for path, right, wrong in (
        (header, "T[3] = ", "T[3] = 1e-6 + "),
        (solver, "joint.foffset = (IkReal)q[k][i];", "joint.foffset = (IkReal)q[k][0];"),
    ):
        text = path.read_text(encoding="utf-8")
        assert right in text
        path.write_text(text.replace(right, wrong, 1), encoding="utf-8")
    assert main(["check", str(tmp_path), "--quiet"]) == 1
    statuses = outcome(tmp_path)
    assert statuses["C++", "forward kinematics equal the exact ones"] == "failed"
    assert statuses["ikfast", "every solution of ComputeIk leads back to its pose"] == "failed"
    assert statuses["ikfast", "ComputeFk equals the exact forward kinematics"] == "passed"
    said = capsys.readouterr().err
    assert "gudel_fp1.hpp is not what kinsym would write today: it was changed" in said


@pytest.mark.usefixtures("few_poses")
def test_other_targets_of_a_robot_without_numbers_are_still_checked(tmp_path: Path) -> None:
    """check asks for the targets that are there: ikfast would refuse parameters without a value."""
    assert main(["derive", "planar_rr", "--target", "numpy", "-o", str(tmp_path), "--quiet", "--no-check"]) == 0
    assert main(["check", str(tmp_path), "--quiet"]) == 0
    assert main(["derive", "planar_rr", "--target", "ikfast", "-o", str(tmp_path), "--quiet"]) == 2


@pytest.mark.usefixtures("few_poses")
def test_without_a_compiler_they_are_written_unchecked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path / "nothing"))
    monkeypatch.delenv("CXX", raising=False)
    assert main(["derive", "gudel_fp1", "--target", "ikfast", "-o", str(tmp_path), "--quiet"]) == 0
    assert outcome(tmp_path)["ikfast", "compiles without a warning"] == "not run"


@pytest.mark.usefixtures("few_poses")
@pytest.mark.parametrize("name", ["core", "fk", "own", "Pose"])
def test_a_robot_may_be_called_as_what_is_in_the_header(name: str, tmp_path: Path) -> None:
    table = ["--dh", "0 l1 0 theta1", "--convention", "paul", "--bind", "l1=0.4", "--name", name]
    assert main(["derive", *table, "--target", "cpp", "--target", "ikfast", "--quiet", "-o", str(tmp_path)]) == 0
