"""One browser for all tests of a process, and pages opened in it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.page.browser import Browser, find_chromium
from tests.page.pages import Made, made


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """A headless Chromium."""
    if find_chromium() is None:
        pytest.skip("chromium is not installed")
    with Browser() as running:
        yield running


@pytest.fixture
def opened(browser: Browser, tmp_path: Path) -> Any:
    """A function that opens the page of an arm."""

    def open_page(name: str, **options: Any) -> Made:
        page = made(name)
        file = tmp_path / f"{name}.html"
        file.write_text(page.text, encoding="utf-8")
        browser.open(file, **options)
        return page

    return open_page
