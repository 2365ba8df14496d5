"""Compiled templates: taken from the folder, never of another text, and never in the way."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import jinja2
import pytest

from kinsym.emit.template_cache import TemplateCache


def rendered(text: str, folder: Path) -> str:
    """A template of this text, in an environment of its own."""
    loader = jinja2.DictLoader({"t": text})
    return jinja2.Environment(loader=loader, bytecode_cache=TemplateCache(folder)).get_template("t").render(x=2)


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The texts that were compiled."""
    texts: list[str] = []
    usual = jinja2.Environment._parse

    def parse(self: jinja2.Environment, source: str, *others: str | None) -> jinja2.nodes.Template:
        texts.append(source)
        return usual(self, source, *others)

    monkeypatch.setattr(jinja2.Environment, "_parse", parse)
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    return texts


def test_a_text_is_compiled_once(tmp_path: Path, compiled: list[str]) -> None:
    """The second environment takes the file; another text replaces it."""
    folder = tmp_path / "__pycache__"
    assert [rendered(text, folder) for text in ("{{ x }}", "{{ x }}", "{{ x + 1 }}", "{{ x + 1 }}")] == list("2233")
    assert compiled == ["{{ x }}", "{{ x + 1 }}"]
    assert len(list(folder.iterdir())) == 1


@pytest.mark.parametrize("damage", [b"", b"nonsense", "cut"])
def test_a_damaged_file_is_compiled_anew(tmp_path: Path, compiled: list[str], damage: bytes | str) -> None:
    """Empty, foreign or cut off in the middle."""
    rendered("{{ x }}", tmp_path)
    (file,) = tmp_path.iterdir()
    file.write_bytes(damage if isinstance(damage, bytes) else file.read_bytes()[:-20])
    assert rendered("{{ x }}", tmp_path) == "2"
    assert compiled == ["{{ x }}"] * 2


def test_where_nothing_can_be_kept_nothing_is(tmp_path: Path, compiled: list[str]) -> None:
    """A file in the place of the folder; and Python told to write no compiled code."""
    (tmp_path / "file").touch()
    assert rendered("{{ x }}", tmp_path / "file") == "2"
    sys.dont_write_bytecode = True
    assert rendered("{{ x }}", tmp_path / "none") == "2"
    assert not (tmp_path / "none").exists()
    assert compiled == ["{{ x }}"] * 2


def test_what_cannot_be_moved_into_place_leaves_nothing(
    tmp_path: Path, compiled: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A disk that is full at the last step: the page is there, and no half of a file."""

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    assert rendered("{{ x }}", tmp_path) == "2"
    assert list(tmp_path.iterdir()) == []
