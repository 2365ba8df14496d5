"""The site is built from the pages as they are, and a link that leads nowhere ends the build."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.docs.reading import ROOT


def build(folder: Path, root: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(ROOT / "docs" / "site" / "build.py"), str(folder), "--root", str(root)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """What the site is made of, in a place where it can be broken."""
    root = tmp_path / "copy"
    shutil.copytree(ROOT / "docs", root / "docs")
    shutil.copytree(ROOT / "notebooks", root / "notebooks")
    for path in (*ROOT.glob("*.md"), *ROOT.glob("*.cff")):
        shutil.copy(path, root)
    return root


def test_every_link_of_the_site_leads_somewhere(tmp_path: Path) -> None:
    """In the HTML that is written; pages have the fences of their source, and comments are gone."""
    done = build(tmp_path, ROOT)
    assert (done.returncode, done.stderr) == (0, "")
    pages = {path.name: path.read_text(encoding="utf-8") for path in tmp_path.glob("*.html")}
    for name, text in pages.items():
        assert "<!--" not in text
        for link in re.findall(r'(?:href|src)="([^"]*)"', text):
            path, _, anchor = link.partition("#")
            if "://" not in link:
                assert (tmp_path / (path or name)).is_file(), (name, link)
                assert not anchor or f'id="{anchor}"' in pages[path or name], (name, link)
    assert '<div class="file">two_links.toml</div>' in pages["index.html"]
    assert '<a href="how_it_works.html"' in pages["index.html"]
    assert (tmp_path / "docs" / "images" / "ur5_branches.svg").is_file()


@pytest.mark.parametrize(
    ("line", "fault"),
    [
        ("[gone](gone.md)", "docs/faq.md: nothing is there for gone.md"),
        ("[outside](../../secret)", "docs/faq.md: nothing is there for ../../secret"),
        ("[part](solvers.md#gone)", "docs/faq.md: docs/solvers.md has no heading for solvers.md#gone"),
        ("[here](#gone)", "docs/faq.md: docs/faq.md has no heading for #gone"),
        ("![gone](images/gone.svg)", "docs/faq.md: nothing is there for images/gone.svg"),
        ("<script>1</script>", "docs/faq.md: raw HTML: <script>1</script>"),
    ],
)
def test_what_leads_nowhere(copy: Path, tmp_path: Path, line: str, fault: str) -> None:
    page = copy / "docs" / "faq.md"
    page.write_text(f"{page.read_text(encoding='utf-8')}\n\n{line}\n", encoding="utf-8")
    done = build(tmp_path / "site", copy)
    assert done.returncode == 1
    assert done.stderr.splitlines() == [fault]
    assert not (tmp_path / "site").exists()


def test_pages_that_come_and_go(copy: Path, tmp_path: Path) -> None:
    """A page needs a menu, and one of a menu must be there."""
    (copy / "docs" / "new.md").write_text("# New\n", encoding="utf-8")
    (copy / "CHANGELOG.md").unlink()
    faults = build(tmp_path / "site", copy).stderr
    assert "docs/new.md: no menu has this page" in faults
    assert "CHANGELOG.md: the page is missing" in faults
