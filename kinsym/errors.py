"""The one exception family of kinsym.

Every message has three parts: what is wrong, where it is, how to mend it. The command line turns a
:class:`KinsymError` into one line on standard error and into the exit status the class carries.
"""

from __future__ import annotations


class KinsymError(Exception):
    """What the user did, asked for or owns cannot be used; ``str(error)`` says what, where and how to mend it."""

    exit_status = 2


class UsageError(KinsymError):
    """The words of a command line cannot be understood."""


class RobotError(KinsymError):
    """The description of the robot is wrong."""

    def __init__(self, what: str, *, where: str = "", remedy: str = "") -> None:
        self.what, self.where, self.remedy = what, where, remedy
        head = f"{where}: {what}" if where else what
        super().__init__(f"{head}. {remedy}" if remedy else head)


class OutputError(KinsymError):
    """The files cannot be written or read back."""


class NoClosedForm(KinsymError):
    """The search ended without a plan; the message names what is left and which geometry blocks it.

    ``verdict`` is the same as data (:class:`kinsym.inverse.verdict.Verdict`) or the message itself; what would help is
    worked out when it is read.
    """

    exit_status = 1

    def __init__(self, verdict: object) -> None:
        self.verdict = verdict
        super().__init__(verdict)


class DoesNotApply(KinsymError):
    """A method was asked for that does not fit the robot; the message says which axes, joints or rows are why."""

    exit_status = 1


class DeadlineExceeded(KinsymError):
    """The derivation took longer than the user allows; the message says what was reached."""


class CheckFailed(KinsymError):
    """Generated source disagrees with the equations it was made from."""

    exit_status = 1
