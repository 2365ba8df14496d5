"""What runs the pages notices what does not hold: a page that is wrong must not pass."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.docs.pictures import same_picture
from tests.docs.reading import blocks
from tests.docs.running import Session

PICTURE = '<!-- x [m] --><g id="bodies"><path d="M 1 2 L 3 4"/></g>'


def run(page: str, folder: Path) -> None:
    session = Session(folder)
    for block in blocks(page):
        session.run(block)


@pytest.mark.parametrize(
    "page",
    [
        "```console\n$ kinsym --version\nkinsym ...\n```",
        "```console\n$ kinsym robots planar_rr  # one\n...\n...planar_rr...\n...\n```",
        "```console\n$ kinsym show nobody\nkinsym: the gallery has no robot ...\n```",
        "```sh two.sh\necho two\n```\n\n```console\n$ sh two.sh | cat\ntwo\n$ cat \\\n    two.sh\necho two\n```",
        "```python\nx = [1]\n```\n\n```python\nprint(x)  # [1]\n```",
        "```python\nx, y = [[1, 2]], 3  # (m, 2), ()\n```",
        "<!-- not run: no machine has it -->\n```ada\nbegin\n```",
        "```text\nnothing\n```",
        "It was written by\n\n    python -m tests.stress ur5\n",
    ],
)
def test_what_holds(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    run(page, tmp_path)


@pytest.mark.parametrize(
    "page",
    [
        "```console\n$ kinsym --version\nkinsym 9\n```",
        "```console\n$ kinsym show nobody\n```",
        "```console\n$ kinsym --version\nkinsym: it fails\n```",
        "```console\nkinsym --version\n```",
        "```console\n$ false\n```",
        "```console\n$ echo 1; echo 2\n1\n```",
        "```python\nprint(1)  # 2\n```",
        "```python\nx = [1, 2]  # (3,)\n```",
        "```python\nx = [1, 2]  # ()\n```",
        "```python\nx, y = 1, 2  # ()\n```",
        "```ada\nbegin\n```",
        "```\nbegin\n```",
        "Text\n\n    kinsym --version\n",
        "<!-- not run: -->\n```ada\nbegin\n```",
        "<!-- not run: why -->\n\nSomething else.\n\n```ada\nbegin\n```",
    ],
)
def test_what_does_not(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(AssertionError):
        run(page, tmp_path)


def test_pictures() -> None:
    """A line moved, a word changed, an arm gone."""
    assert same_picture(PICTURE, PICTURE.replace("3 4", "3.001 4"))
    assert not same_picture(PICTURE, PICTURE.replace("3 4", "3.1 4"))
    assert not same_picture(PICTURE, PICTURE.replace("[m]", "[mm]"))
    assert not same_picture(PICTURE, "<!-- x [m] -->")
