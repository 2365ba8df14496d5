"""Every law on a few random arms, the same ones on every machine; more by ``python -m tests.laws``."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.emit.built import needs_compiler
from tests.laws.laws import LAWS
from tests.laws.robots import tables
from tests.laws.tables import Table


@pytest.mark.parametrize("law", LAWS)
@settings(max_examples=5)
@given(table=tables(), seed=st.integers(0, 999))
def test_random_arms_keep_the_law(law: str, table: Table, seed: int) -> None:
    LAWS[law](table, "numpy", np.random.default_rng(seed))


@needs_compiler
@pytest.mark.parametrize("law", ["closure", "completeness"])
@settings(max_examples=2)
@given(table=tables(), seed=st.integers(0, 999))
def test_the_same_in_c(law: str, table: Table, seed: int) -> None:
    LAWS[law](table, "c", np.random.default_rng(seed))
