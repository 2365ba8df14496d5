"""The folder that comes out is a package for pip, and ``kinsym derive`` and ``kinsym check`` handle it as a whole."""

from __future__ import annotations

import ast
import json
import os
import shlex
import subprocess
import sys
import sysconfig
import tomllib
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

import pytest

from kinsym.check.extension import load_package
from kinsym.cli import main
from kinsym.command.rendering import FILES, file_names, rendered
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.robot import load
from tests.extension.built import derivation

PLANAR = "planar_rr"
PAGE = (Path(__file__).resolve().parents[2] / "docs" / "solvers.md").read_text(encoding="utf-8")


def installed(folder: Path, target: Path) -> None:
    """What a user does, without a network: pip builds with the setuptools that is there."""
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-build-isolation", "--no-deps", "--no-index"]
    environment = {**os.environ, "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    finished = subprocess.run(
        [*command, "--target", str(target), str(folder)], capture_output=True, text=True, check=False, env=environment
    )
    assert finished.returncode == 0, finished.stderr


def test_pip_installs_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The commands of docs/solvers.md: derive, ``pip install``, import, solve. One wheel for every CPython; typed."""
    monkeypatch.chdir(tmp_path)
    (commands,) = (block for block in PAGE.split("```console\n") if "pip install ./" in block)
    first, second, third = (shlex.split(line.removeprefix("$ ")) for line in commands.split("```")[0].splitlines())
    assert main([*first[1:], "--no-check", "--quiet"]) == 0
    installed(Path(second[-1]), tmp_path / "site")
    names = {path.name for path in (tmp_path / "site" / "ur5").iterdir() if path.is_file()}
    assert names >= {"__init__.py", "_arguments.py", "_arguments.pyi", "_core.pyi", "py.typed"}
    (compiled,) = (name for name in names if name.startswith("_core.") and name.endswith(tuple(EXTENSION_SUFFIXES)))
    (wheel,) = (tmp_path / "site").glob("*.dist-info/WHEEL")
    if sys.implementation.name == "cpython" and not sysconfig.get_config_var("Py_GIL_DISABLED"):
        assert "cp311-abi3" in wheel.read_text()
        assert os.name == "nt" or "abi3" in compiled
    environment = {**os.environ, "PYTHONPATH": str(tmp_path / "site")}
    answer = subprocess.run([sys.executable, *third[1:]], capture_output=True, text=True, check=True, env=environment)
    assert "[ 0.1         0.2         0.3         0.4         0.5         0.6       ]" in answer.stdout


def test_the_readme_runs(tmp_path: Path) -> None:
    """The example in the README of a package that was installed, for arms that need more than a pose."""
    for name in ("kuka_iiwa", PLANAR):
        found = derivation(name)
        texts = rendered(found, build_schedule(found), ("extension",))
        folder = tmp_path / name
        for path, text in texts.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text, encoding="utf-8")
        installed(folder / f"{name}-solver", folder / "site")
        snippet = texts[f"{name}-solver/README.md"].split("```python\n")[1].split("```")[0]
        environment = {**os.environ, "PYTHONPATH": str(folder / "site")}
        subprocess.run([sys.executable, "-c", snippet + "assert len(q)"], check=True, env=environment)


@pytest.mark.usefixtures("few_poses")
def test_it_is_written_when_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Beside other targets in a folder of its own; not among those that are written anyway."""
    assert not any("solver" in name for name in file_names(PLANAR))
    assert main(["derive", PLANAR, "--target", "extension", "--target", "numpy", "-o", str(tmp_path)]) == 0
    files = sorted(str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*") if path.is_file())
    assert files == sorted([*file_names(PLANAR, ("numpy", "extension")), f"{PLANAR}.report.json"])
    assert "NumPy and extension" in capsys.readouterr().out
    report = json.loads((tmp_path / f"{PLANAR}.report.json").read_text())
    assert report["checked"] == "passed"
    assert set(report["files"]) == set(file_names(PLANAR, ("numpy", "extension")))


@pytest.mark.usefixtures("few_poses")
def test_check_looks_at_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Passed as it was written; failed when its C is changed; a file that is missing is named."""
    assert main(["derive", PLANAR, "--target", "extension", "--quiet", "-o", str(tmp_path)]) == 0
    assert main(["check", str(tmp_path)]) == 0
    assert "extension" in capsys.readouterr().out
    core = tmp_path / f"{PLANAR}-solver" / "c" / "_core.c"
    text = core.read_text()
    core.write_text(text.replace("function(&from[k * JOINTS]", "function(&from[0]"))
    assert main(["check", str(tmp_path)]) == 1
    assert "_core.c is not what kinsym would write" in capsys.readouterr().err
    core.unlink()
    assert main(["check", str(tmp_path)]) == 1
    assert "_core.c is missing" in capsys.readouterr().err


def test_every_file_is_announced() -> None:
    """The names that are checked before a derivation are those that are written, for any robot."""
    for target in FILES:
        name = "ur5" if target == "ikfast" else PLANAR  # which has no numbers, and ikfast needs them
        found = derivation(name)
        assert list(rendered(found, build_schedule(found), (target,))) == file_names(name, (target,))


@pytest.mark.usefixtures("few_poses")
@pytest.mark.parametrize("name", ["core", "c", "src", "build", "py"])
def test_names_of_its_own_files(name: str, tmp_path: Path) -> None:
    """A robot may be called as a file or folder of the package is; it is built and checked."""
    table = ["--dh", "0 l1 0 theta1", "--convention", "paul", "--bind", "l1=0.4", "--name", name]
    assert main(["derive", *table, "--target", "extension", "--quiet", "-o", str(tmp_path)]) == 0
    checks = json.loads((tmp_path / f"{name}.report.json").read_text())["checks"]
    assert {"law": "the package can be built", "subject": "extension"}.items() <= checks[0].items()


@pytest.mark.parametrize("name", ["numpy", "setuptools", "pip", "math"])
def test_names_of_packages_that_it_needs(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Installed, it would take their place."""
    table = ["--dh", "0 l1 0 theta1", "--convention", "paul", "--name", name]
    assert main(["derive", *table, "--target", "extension", "-o", str(tmp_path / "x")]) == 2
    assert "the generated Python may need" in capsys.readouterr().err
    assert not (tmp_path / "x").exists()


def test_titles_stay_titles(tmp_path: Path) -> None:
    """A title that would end a comment, a string or a heading is text in every file of the package."""
    title = 'arm */ """ \' \\ ``` ]] ??/'
    path = tmp_path / "hostile.toml"
    rows = '{ type = "R", alpha = "0", a = "0.4", d = "0", theta = "theta1" }'
    path.write_text(
        f'name = "hostile"\ntitle = {json.dumps(title)}\nconvention = "paul"\ntask = "position"\njoints = [{rows}]\n'
    )
    found = derive(load(str(path)))
    texts = rendered(found, build_schedule(found), ("extension",))
    for name, text in texts.items():
        if name.endswith((".py", ".pyi")):
            ast.parse(text)
    described = tomllib.loads(texts["hostile-solver/pyproject.toml"])["project"]["description"]
    assert described == f"Kinematics of {title}"
    assert texts["hostile-solver/c/_core.c"].count("*/") == texts["hostile-solver/c/_core.c"].count("/*")


def test_a_package_that_was_not_built(tmp_path: Path) -> None:
    """Imported from its source it says so; no half of it stays in memory."""
    found = derivation(PLANAR)
    for name, text in rendered(found, build_schedule(found), ("extension",)).items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(ImportError, match="_core"):
        load_package(tmp_path / f"{PLANAR}-solver" / "src" / PLANAR)
    assert not [name for name in sys.modules if name.startswith("_kinsym_checked")]
