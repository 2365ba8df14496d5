"""A set of files arrives whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from kinsym.errors import OutputError
from kinsym.write import check_place, write_set

NOBODY = 65534
FILES = {"a.py": "one\n", "a.c": "two\n"}


def contents(folder: Path) -> dict[str, str]:
    """Every file below a folder."""
    return {str(path.relative_to(folder)): path.read_text() for path in sorted(folder.rglob("*")) if path.is_file()}


def test_writes_into_new_folders(tmp_path: Path) -> None:
    """The folder and those above it are made; nothing but the files is left there."""
    paths = write_set(tmp_path / "x" / "y", FILES)
    assert [path.name for path in paths] == ["a.py", "a.c"]
    assert contents(tmp_path) == {"x/y/a.py": "one\n", "x/y/a.c": "two\n"}


def test_pictures_are_written_as_they_are(tmp_path: Path) -> None:
    """Bytes beside texts; no line end is changed."""
    write_set(tmp_path, {"a.png": b"\x89PNG\r\n", "a.svg": "one\r\ntwo\n"})
    assert (tmp_path / "a.png").read_bytes() == b"\x89PNG\r\n"
    assert (tmp_path / "a.svg").read_bytes() == b"one\r\ntwo\n"


def test_leaves_other_files_alone(tmp_path: Path) -> None:
    """Same names are replaced, other names are not touched."""
    (tmp_path / "mine.txt").write_text("mine")
    (tmp_path / "a.py").write_text("old")
    write_set(tmp_path, FILES)
    assert contents(tmp_path) == {"a.py": "one\n", "a.c": "two\n", "mine.txt": "mine"}


def test_a_failed_move_restores_everything(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The second move fails: the first file is what it was, and the new one is gone."""
    (tmp_path / "a.py").write_text("old")
    real, moved = os.replace, []

    def failing(source: Path, target: Path) -> None:
        if Path(target).name == "a.c" and not moved:
            moved.append(target)
            raise OSError(28, "No space left on device")
        real(source, target)

    monkeypatch.setattr(os, "replace", failing)
    with pytest.raises(OutputError, match="no space left"):
        write_set(tmp_path, FILES)
    assert contents(tmp_path) == {"a.py": "old"}
    assert os.listdir(tmp_path) == ["a.py"]


def test_a_failed_write_leaves_no_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder that was made for the files goes with them."""

    def failing(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", failing)
    with pytest.raises(OutputError):
        write_set(tmp_path / "x" / "y", FILES)
    assert os.listdir(tmp_path) == []


def test_sub_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """They are made for their files, hold others' files as well, and go again if the set cannot be written."""
    deep = {"a.py": "one\n", "x/y/b.py": "two\n", "x/c.py": "three\n"}
    write_set(tmp_path, deep)
    (tmp_path / "x" / "mine.txt").write_text("mine")
    write_set(tmp_path, {**deep, "x/c.py": "four\n"})
    assert contents(tmp_path) == {**deep, "x/c.py": "four\n", "x/mine.txt": "mine"}

    def failing(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", failing)
    with pytest.raises(OutputError):
        write_set(tmp_path, {"x/z/d.py": "five\n"})
    assert contents(tmp_path) == {**deep, "x/c.py": "four\n", "x/mine.txt": "mine"}
    assert not (tmp_path / "x" / "z").exists()


def test_a_file_in_the_way_of_a_sub_folder(tmp_path: Path) -> None:
    """Told before anything is written."""
    (tmp_path / "x").write_text("file")
    with pytest.raises(OutputError, match="is a file"):
        write_set(tmp_path, {"a.py": "one\n", "x/b.py": "two\n"})
    assert contents(tmp_path) == {"x": "file"}


def test_a_file_in_the_way_of_the_folder(tmp_path: Path) -> None:
    """Told before anything is written."""
    (tmp_path / "x").write_text("file")
    for folder in (tmp_path / "x", tmp_path / "x" / "y"):
        with pytest.raises(OutputError, match="is a file"):
            write_set(folder, FILES)
    assert contents(tmp_path) == {"x": "file"}


def test_a_folder_in_the_way_of_a_file(tmp_path: Path) -> None:
    """Told before the other file is written."""
    (tmp_path / "a.c").mkdir()
    with pytest.raises(OutputError, match="is a folder"):
        write_set(tmp_path, FILES)
    assert os.listdir(tmp_path) == ["a.c"]


@pytest.mark.parametrize("name", ["../a", "/etc/a", "x/../../y", "x//y", "x/", "", "..", "."])
def test_names_stay_inside(tmp_path: Path, name: str) -> None:
    """No name leads out of the folder."""
    with pytest.raises(OutputError, match="no file name below"):
        check_place(tmp_path, [name])


@pytest.fixture
def guarded() -> Iterator[Path]:
    """A folder that its user may not write into; root, who may write anywhere, becomes nobody for the test."""
    folder, user = Path(tempfile.mkdtemp()), os.geteuid()
    if user == 0:
        os.chown(folder, NOBODY, NOBODY)
        os.seteuid(NOBODY)
    folder.chmod(0o500)
    yield folder
    os.seteuid(user)
    folder.rmdir()


def test_unwritable(guarded: Path) -> None:
    """A folder without permission, and one that cannot be made."""
    for folder in (guarded, guarded / "x"):
        with pytest.raises(OutputError, match="does not allow writing"):
            write_set(folder, FILES)
    assert os.listdir(guarded) == []


def test_a_place_that_is_no_path(tmp_path: Path) -> None:
    """A zero byte, a name too long: a message, no traceback."""
    for name in ("x\0y", "x" * 5000):
        with pytest.raises(OutputError):
            write_set(tmp_path / name, FILES)
