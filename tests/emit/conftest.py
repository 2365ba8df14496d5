"""What several tests of emitted code share."""

from __future__ import annotations

import pytest

from tests.emit.built import needs_compiler
from tests.emit.kernel_calls import Kernel, in_c, in_numpy


@pytest.fixture(params=[pytest.param(in_c, id="c", marks=needs_compiler), pytest.param(in_numpy, id="numpy")])
def kernel(request: pytest.FixtureRequest) -> Kernel:
    """A kernel by its rule, in each language."""
    return request.param
