"""The readers on a fixed corpus, on what hypothesis makes of it, and for some seconds under the fuzzer itself."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.fuzz.targets import TARGETS, run, seeds, words
from tests.hostile.attacks import ATTACKS

ROOT = Path(__file__).resolve().parents[2]

#: Inputs that once made a reader fail.
FOUND: list[tuple[str, bytes]] = []


@pytest.mark.parametrize("reader", TARGETS)
def test_corpus(reader: str) -> None:
    """The seeds are accepted; the seeds cut short, the attacks and what was found are accepted or refused."""
    for seed in seeds(reader):
        assert run(reader, seed)
        for end in range(0, len(seed), max(1, len(seed) // 25)):
            run(reader, seed[:end])
    for text in ATTACKS.values():
        run(reader, text.encode("utf-8", "surrogatepass"))
    for known, data in FOUND:
        if known == reader:
            run(reader, data)


@st.composite
def damaged(draw: st.DrawFn, reader: str) -> bytes:
    """A seed with pieces taken out, put in from the words of the formats, or moved from one place to another."""
    data = draw(st.sampled_from(list(seeds(reader))))
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(data)))
        end = min(len(data), start + draw(st.integers(0, 20)))
        piece = draw(
            st.one_of(
                st.sampled_from(words()).map(str.encode),
                st.integers(0, len(data)).map(lambda at: data[at : at + 12]),  # noqa: B023, drawn at once
                st.binary(max_size=4),
            )
        )
        data = data[:start] + piece + data[end:]
    return data


@pytest.mark.parametrize("reader", TARGETS)
def test_damaged_files(reader: str) -> None:
    """A robot that reads back as itself, or one message."""

    @settings(max_examples=120)
    @given(damaged(reader))
    def law(data: bytes) -> None:
        run(reader, data)

    law()


@pytest.mark.skipif(importlib.util.find_spec("atheris") is None, reason="atheris is not installed")
def test_some_seconds_under_the_fuzzer() -> None:
    """Every reader for two seconds; ``python -m tests.fuzz`` takes as long as one likes."""
    command = [sys.executable, "-m", "tests.fuzz", "--minutes", "0.17"]
    finished = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert finished.returncode == 0, finished.stdout
    assert [line.partition(":")[0] for line in finished.stdout.splitlines()] == list(TARGETS)
    assert all("no inputs" not in line for line in finished.stdout.splitlines())
