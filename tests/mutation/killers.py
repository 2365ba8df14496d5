"""Which tests a mutant has to face: those that concern its module, in stages, the fastest and deadliest first."""

from __future__ import annotations

GOLDEN = "tests/mutation/golden.py"
CLASSES = "tests/inverse/test_classes.py"

#: By the beginning of a module's name, the longest that fits; every list is preceded by the module's own examples.
KILLERS: dict[str, tuple[str, ...]] = {
    "kinsym/algebra/": (GOLDEN, "tests/algebra", "tests/kinematics/test_singular.py"),
    "kinsym/algebra/symbolic.py": ("tests/algebra", "tests/test_api.py"),
    "kinsym/kinematics/": (GOLDEN, "tests/kinematics"),
    "kinsym/kinematics/singular/": (GOLDEN, "tests/kinematics/test_singular.py", "tests/inverse/test_families.py"),
    "kinsym/kinematics/tasks.py": (GOLDEN, "tests/inverse/test_plan.py", "tests/inverse/test_locks.py"),
    "kinsym/kinematics/convert.py": ("tests/kinematics/test_convert.py",),
    "kinsym/inverse/": (GOLDEN, "tests/inverse/test_pool.py", "tests/inverse/test_plan.py", CLASSES),
    "kinsym/inverse/branches.py": (GOLDEN, "tests/control/test_branches.py"),
    "kinsym/inverse/features.py": (GOLDEN, "tests/control/test_branches.py"),
    "kinsym/inverse/families.py": (GOLDEN, "tests/inverse/test_families.py"),
    "kinsym/inverse/locks.py": ("tests/inverse/test_locks.py", GOLDEN),
    "kinsym/inverse/neighbours.py": ("tests/inverse/test_verdict.py", "tests/inverse/test_plan.py"),
    "kinsym/inverse/nonzero.py": (GOLDEN, "tests/inverse/test_nonzero.py"),
    "kinsym/inverse/verdict.py": ("tests/inverse/test_verdict.py", "tests/inverse/test_plan.py"),
    "kinsym/inverse/rules/square_and_add.py": (GOLDEN, "tests/inverse/test_square_and_add.py", CLASSES),
    "kinsym/inverse/rules/turned_pair.py": (GOLDEN, "tests/inverse/test_square_and_add.py", CLASSES),
}


def stages(module: str) -> tuple[str, ...]:
    """What is given to pytest for a module, one call after the other, until a test fails."""
    longest = max((name for name in KILLERS if module.startswith(name)), key=len)
    return (module, *KILLERS[longest], "tests/test_frozen.py")
