"""What a derivation hands on cannot be changed: its classes are frozen, and what equals counts once in a set."""

from __future__ import annotations

import dataclasses
import importlib
import inspect
import pkgutil

import kinsym.algebra
import kinsym.inverse
import kinsym.kinematics

#: What is filled while a table is read, a way is searched, names are given: nothing of it is handed on.
WORKING = {
    "kinsym.inverse.rules.base.Names",
    "kinsym.inverse.search._Search",
    "kinsym.kinematics.constants.Constants",
}


def test_dataclasses_of_the_derivation_are_frozen() -> None:
    found = {}
    for package in (kinsym.algebra, kinsym.inverse, kinsym.kinematics):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            for _, each in inspect.getmembers(importlib.import_module(module.name), inspect.isclass):
                if dataclasses.is_dataclass(each) and each.__module__ == module.name:
                    found[f"{each.__module__}.{each.__qualname__}"] = each.__dataclass_params__.frozen
    assert len(found) > 60
    assert {name for name, frozen in found.items() if not frozen} == WORKING
