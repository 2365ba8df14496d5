"""One file a library. Each reads the table of an arm in numbers; what it gives is timed or compiled.

``solve(arm)`` and ``batch(arm)`` make callables for the worker, ``generate(arm, folder)`` writes C. All of it runs in
the environment of the libraries, where kinsym is not installed.
"""


class Refused(Exception):
    """The library does not take this arm."""
