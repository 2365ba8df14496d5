"""``kinsym new``: its files can be derived as they stand, are the same arm in three conventions, replace nothing."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from kinsym.cli import main
from kinsym.command.new import JOINTS
from kinsym.command.options import CONVENTIONS
from kinsym.command.starters import STARTERS, starter_file
from kinsym.deriving import derive
from kinsym.kinematics.chain import build_chain
from kinsym.kinematics.forward import forward_kinematics
from kinsym.robot import load
from kinsym.robot.model import Convention

SOLUTIONS = {2: 2, 3: 4, 4: 2, 5: 4, 6: 8, 7: 8}


def test_the_choices_are_those_of_the_starters() -> None:
    """The parser repeats them so as to load nothing."""
    assert tuple(STARTERS) == JOINTS


@pytest.mark.parametrize("joints", JOINTS)
def test_derives_as_it_stands(joints: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In every convention, with a value for every length, and T is the same."""
    monkeypatch.chdir(tmp_path)
    poses = []
    for convention in CONVENTIONS:
        assert main(["new", f"arm_{convention}", "--convention", convention, "--joints", str(joints)]) == 0
        robot = load(f"arm_{convention}.toml")
        assert robot.convention.value == convention
        assert len(robot.variables) == joints
        assert None not in robot.parameters.values()
        poses.append([str(entry) for column in forward_kinematics(build_chain(robot)).columns for entry in column])
    assert poses[0] == poses[1] == poses[2]
    plan = derive(load("arm_paul.toml")).plan
    assert plan is not None
    assert plan.maximum == SOLUTIONS[joints]


def test_what_is_commented_out_can_be_used() -> None:
    """Every commented line that looks like a key or a table, taken as it is."""
    text = starter_file("my_robot", Convention.PAUL, 6)
    body = text[text.index('name = "my_robot"') :]
    lines = [
        line[2:]
        if line.startswith(("# [", "# xyz", "# rpy", "# theta1 =", "# theta2 =", "# task", "# source"))
        else line
        for line in body.splitlines()
    ]
    draft = tomllib.loads("\n".join(lines))
    assert set(draft) == {*"name title convention task source joints parameters base tool locks".split()}
    from kinsym.robot.files import from_draft

    robot = from_draft(draft, where="tests")
    assert (robot.base is None, robot.tool is None, list(robot.locks)) == (False, False, ["theta1", "theta2"])


def test_nothing_is_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A file that is there stays, whatever the convention; a name that cannot be a robot's is refused."""
    monkeypatch.chdir(tmp_path)
    assert main(["new"]) == 0
    before = Path("my_robot.toml").read_bytes()
    for name in ("my_robot", "my_robot.toml"):
        assert main(["new", name, "--convention", "screw"]) == 2
        assert "my_robot.toml is there already" in capsys.readouterr().err
    assert Path("my_robot.toml").read_bytes() == before
    for name in ("../x", "math", "a b", ""):
        assert main(["new", name]) == 2
    assert main(["new", "x", "--convention", "pual"]) == 2
    assert "Did you mean paul?" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["my_robot.toml"]
