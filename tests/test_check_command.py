"""``kinsym check`` on folders that something has happened to."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from kinsym.cli import main
from kinsym.errors import OutputError
from kinsym.journal import JOURNAL

ARM = "planar_rr"


@pytest.fixture
def folder(tmp_path: Path, few_poses: None) -> Path:
    """The NumPy module of an arm with its report, not checked yet."""
    assert main(["derive", ARM, "--target", "numpy", "--no-check", "--quiet", "-o", str(tmp_path / "out")]) == 0
    return tmp_path / "out"


def test_an_interrupted_run_is_undone_and_told(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    private = folder / ".kinsym-abcdefgh"
    (private / "old").mkdir(parents=True)
    (private / JOURNAL).write_text('{"files": {}, "folders": []}')
    assert main(["check", str(folder)]) == 0
    assert f"a run that was interrupted in {folder} is undone: the files are those from before it" in (
        capsys.readouterr().err
    )
    assert not private.exists()


def test_a_report_that_cannot_be_renewed_is_told(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A folder on a disk that is read-only: the verdict holds, and the old report stays."""

    def refused(*_: object, **__: object) -> None:
        raise OutputError("the disk is read-only.")

    before = (folder / f"{ARM}.report.json").read_text()
    monkeypatch.setattr("kinsym.write.write_set", refused)
    assert main(["check", str(folder)]) == 0
    assert "the report was not renewed: the disk is read-only." in capsys.readouterr().err
    assert (folder / f"{ARM}.report.json").read_text() == before


def test_what_stands_in_the_place_of_a_file(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Bytes that are no text, then a folder: status 2, and what to do."""
    module = folder / f"{ARM}.py"
    module.write_bytes(b"\xff\xfe")
    assert main(["check", str(folder)]) == 2
    assert f"{module} cannot be read: 'utf-8' codec" in capsys.readouterr().err
    module.unlink()
    module.mkdir()
    assert main(["check", str(folder)]) == 2
    assert f"{module} is no plain file. Remove it and derive the robot again." in capsys.readouterr().err


def test_only_the_files_that_the_report_speaks_of(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A target of which the user has thrown one file away, in the report as well, is checked by what is left."""
    assert main(["derive", ARM, "--target", "numpy", "--target", "c", "--no-check", "--quiet", "-o", str(folder)]) == 0
    report = folder / f"{ARM}.report.json"
    content = json.loads(report.read_text())
    for name in (f"{ARM}.c", f"{ARM}.h"):
        (folder / name).unlink()
    del content["files"][f"{ARM}.c"]
    report.write_text(json.dumps(content))
    assert main(["check", str(folder)]) == 1
    said = capsys.readouterr().err
    assert f"{ARM}.h is missing" in said
    assert f"{ARM}.c" not in said
