"""What a user reads off an open page and does to it."""

from __future__ import annotations

import json

import numpy as np

from tests.page.browser import Browser


def pose(browser: Browser) -> np.ndarray:
    """T as it stands on the page, (4, 4), all digits."""
    cells = browser.run('[...document.querySelectorAll("#pose td")].map((cell) => Number(cell.dataset.value))')
    return np.array(cells).reshape(4, 4)


def set_slider(browser: Browser, joint: int, value: float) -> None:
    """Move the slider of a joint, as a hand would: degrees where it turns, a length where it slides."""
    browser.run(
        f"(() => {{ const range = document.getElementById('joint{joint}'); range.value = {value};"
        " range.dispatchEvent(new Event('input', { bubbles: true })); })()"
    )


def centre(browser: Browser, selector: str) -> tuple[float, float]:
    """The middle of an element in the window."""
    x, y = browser.run(
        f"(() => {{ const box = document.querySelector({json.dumps(selector)}).getBoundingClientRect();"
        " return [box.x + box.width / 2, box.y + box.height / 2]; })()"
    )
    return x, y
