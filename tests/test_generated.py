"""The gallery, derived and checked again, equals what is committed in ``generated/``.

This is where every robot of the gallery goes through every check. After a change that is meant:
``python -m tests.regenerate``, then read the difference.
"""

from __future__ import annotations

import difflib

import pytest

from kinsym.check.report import FAILED
from kinsym.robot import gallery, gallery_index
from tests.regenerate import GENERATED, comparable, files_of


@pytest.mark.parametrize("name", gallery())
def test_gallery(name: str) -> None:
    """Same bytes, the same line in the gallery's index, and no check fails."""
    files, findings, entry = files_of(name)
    assert gallery_index()[name] == entry
    assert [check for check in findings.checks if check.status == FAILED] == []
    there = {path.name: path.read_text(encoding="utf-8") for path in (GENERATED / name).glob("*")}
    assert sorted(there) == sorted(files)
    for key, text in files.items():
        difference = "".join(
            difflib.unified_diff(
                comparable(key, there[key]).splitlines(keepends=True),
                comparable(key, text).splitlines(keepends=True),
                f"generated/{name}/{key}",
                "derived now",
                n=2,
            )
        )
        assert not difference, f"{difference}\nIf this is meant: python -m tests.regenerate {name}"


def test_no_folder_without_a_robot() -> None:
    """What left the gallery leaves ``generated/`` and the index."""
    assert list(gallery_index()) == list(gallery())
    assert sorted(path.name for path in GENERATED.iterdir() if path.is_dir()) == list(gallery())
