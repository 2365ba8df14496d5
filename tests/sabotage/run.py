"""Mutants one after the other, each in a process of its own: what was changed may crash or never end."""

from __future__ import annotations

import faulthandler
import multiprocessing
import random
import resource
import signal
import warnings
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from kinsym.derivation import Derivation
from kinsym.emit.program import build_schedule
from tests.sabotage import c_text, plan, python_text
from tests.sabotage.asking_c import of_c
from tests.sabotage.asking_numpy import of_numpy
from tests.sabotage.bench import Bench, Caught, Stillborn, choices, hold_plan
from tests.sabotage.bench import c_text as c_source
from tests.sabotage.bench import numpy_text as numpy_source
from tests.sabotage.inputs import Inputs, inputs
from tests.sabotage.mutant import Mutant
from tests.sabotage.transcript import Difference, difference

LANGUAGES = (c_text.LANGUAGE, python_text.LANGUAGE, plan.LANGUAGE)

CAUGHT, EQUAL, ROUNDING, SURVIVED, STILLBORN = (
    "caught",
    "equal to the bit",
    "equal to rounding",
    "SURVIVED",
    "stillborn",
)
#: What a child tells before it compares.
PASSED = "passed"
ENDLESS = "the checks do not end"
CRASHED = "the checks crash"

#: Seconds of processor time and bytes that a mutant may take.
SECONDS, BYTES = 180, 6 * 2**30


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What came of one mutant: a law that failed, or what differs of everything that code can be asked."""

    robot: str
    mutant: Mutant
    outcome: str
    reason: str


class Sabotage:
    """One robot and all its mutants."""

    def __init__(self, derivation: Derivation) -> None:
        self.derivation, self.schedule = derivation, build_schedule(derivation)
        self._good: dict[str, Any] = {}

    @cached_property
    def _bench(self) -> Bench:
        return Bench(self.derivation.robot, self.schedule)

    @cached_property
    def _inputs(self) -> list[Inputs]:
        every = choices(self.derivation.robot, self.schedule)
        return [inputs(self.derivation, self.schedule, parameters) for parameters in every]

    def mutants(self, language: str) -> list[Mutant]:
        """All mutants of one language, in the order of the text."""
        names = tuple(parameter.name for parameter in self.schedule.parameters)
        if language == c_text.LANGUAGE:
            return c_text.mutants(c_source(self.schedule), names)
        if language == python_text.LANGUAGE:
            return python_text.mutants(numpy_source(self.schedule), names)
        return plan.mutants(self.schedule)

    def sample(self, language: str, number: int, seed: int) -> list[Mutant]:
        """``number`` mutants drawn at random, all of them if there are no more; in the order of the text."""
        every = self.mutants(language)
        drawn = random.Random(f"{self.schedule.name} {language} {seed}").sample(range(len(every)), len(every))
        return [every[place] for place in sorted(drawn[:number])]

    def try_out(self, mutant: Mutant) -> Outcome:
        """Hold one mutant to the laws; if it passes, compare what it says with what good code says."""
        self._say(mutant.language)
        context = multiprocessing.get_context("fork")
        ours, theirs = context.Pipe(duplex=False)
        child = context.Process(target=self._child, args=(mutant, theirs))
        child.start()
        theirs.close()
        told: list[tuple[str, str]] = []
        try:
            while len(told) < 2:
                told.append(ours.recv())
        except EOFError:
            pass
        child.join()
        endless = child.exitcode in (-signal.SIGXCPU, -signal.SIGKILL)
        end = ENDLESS if endless else CRASHED
        outcome, reason = told[-1] if told else (CAUGHT, end)
        if outcome == PASSED:
            outcome, reason = SURVIVED, f"beyond what the checks ask: {end}"
        return Outcome(robot=self.schedule.name, mutant=mutant, outcome=outcome, reason=reason)

    def _say(self, language: str) -> None:
        """What good code says, once for all mutants of a language."""
        if language == c_text.LANGUAGE and language not in self._good:
            self._good[language] = of_c(self._bench.library, self.schedule, self._inputs)
        elif language != c_text.LANGUAGE and python_text.LANGUAGE not in self._good:
            self._good[python_text.LANGUAGE] = of_numpy(self._bench.module, self.schedule, self._inputs)

    def _child(self, mutant: Mutant, pipe: Any) -> None:
        faulthandler.disable()
        warnings.simplefilter("ignore")
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
        resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
        try:
            code = self._held(mutant)
        except Caught as law:
            pipe.send((CAUGHT, str(law)))
        except Stillborn as error:
            pipe.send((STILLBORN, str(error).splitlines()[-1]))
        except Exception:  # a broken plan may lead anywhere, and nothing would be written
            pipe.send((CAUGHT, CRASHED))
        else:
            # what happens from here on, the checks do not see
            pipe.send((PASSED, ""))
            pipe.send(self._compared(mutant.language, code))
        pipe.close()

    def _held(self, mutant: Mutant) -> Any:
        """The code of a mutant that passes the checks."""
        if mutant.language == c_text.LANGUAGE:
            return self._bench.hold_c(mutant.make())
        if mutant.language == python_text.LANGUAGE:
            return self._bench.hold_numpy(mutant.make())
        return hold_plan(self.derivation.robot, mutant.make())[0]

    def _compared(self, language: str, code: Any) -> tuple[str, str]:
        """What code that passed says, beside what good code says."""
        told = of_c if language == c_text.LANGUAGE else of_numpy
        good = self._good[c_text.LANGUAGE if language == c_text.LANGUAGE else python_text.LANGUAGE]
        return _judged(difference(good, told(code, self.schedule, self._inputs), self._inputs))


def _judged(found: Difference) -> tuple[str, str]:
    if found.size == 0.0:
        return EQUAL, ""
    if found.size <= 1.0:
        return ROUNDING, f"{found.where}: {found.size:.0e}"
    return SURVIVED, found.where
