"""Every command, file and line of code in the README and in ``docs/`` works as it stands there."""

from __future__ import annotations

import re
import shlex
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from kinsym.cli import COMMANDS
from kinsym.command.parsing import parser_of
from tests.docs.pictures import facets, same_picture
from tests.docs.reading import PAGES, ROOT, blocks, inline_code
from tests.docs.running import Session

FOLDERS = ("docs", "generated", "kinsym", "notebooks", "templates", "tests")
_PATH = re.compile(rf"(?:{'|'.join(FOLDERS)})/[\w./*-]*|[A-Z]+\.(?:md|cff)")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_a_page_shows(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its blocks run in one folder from top to bottom; a picture that a command draws is the committed one."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delenv("NO_COLOR", raising=False)
    loaded = set(sys.modules)
    session = Session(tmp_path)
    try:
        for block in blocks(page.read_text(encoding="utf-8")):
            session.run(block)
    finally:
        for name in set(sys.modules) - loaded:
            if str(getattr(sys.modules[name], "__file__", None) or "").startswith(str(tmp_path)):
                del sys.modules[name]
    for drawn in sorted(tmp_path.glob("docs/images/*.svg")):
        committed = (ROOT / drawn.relative_to(tmp_path)).read_text(encoding="utf-8")
        assert same_picture(committed, drawn.read_text(encoding="utf-8")), drawn.name
        assert facets(committed)
        assert len(committed) < 350_000


def test_every_picture_is_drawn_by_a_command() -> None:
    """A page says how each picture in docs/images is made."""
    shown = [block.text for page in PAGES for block in blocks(page.read_text(encoding="utf-8")) if not block.reason]
    for picture in sorted((ROOT / "docs" / "images").glob("*.svg")):
        assert any(f"-o docs/images/{picture.name}" in text for text in shown), picture.name


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_a_page_names(page: Path) -> None:
    """Commands and their options, modules and files named in sentences are there."""
    for code in inline_code(page.read_text(encoding="utf-8")):
        if code.startswith("kinsym "):
            check_command(code)
        elif found := re.fullmatch(r"python -m (tests\S*|kinsym)(?: .*)?", code):
            assert find_spec(found[1]), code
        elif _PATH.fullmatch(code):
            assert any(ROOT.glob(code.rstrip("/*") + "*")), code


def check_command(code: str) -> None:
    """AssertionError unless there is such a command with such options."""
    words = shlex.split(code.partition(" > ")[0])[1:]
    if words[0] == "--version":
        return
    assert words[0] in COMMANDS, code
    known = parser_of(words[0], COMMANDS[words[0]]).options()
    for word in words[1:]:
        assert not word.startswith("-") or word.partition("=")[0] in known, code
