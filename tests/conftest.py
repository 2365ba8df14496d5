"""Settings of the whole suite: hypothesis draws the same examples everywhere and never judges by the clock.

Programs that tests start can be interrupted, whatever the suite itself was started by: a shell has its background jobs
ignore Ctrl-C, and with them all that they start.
"""

from __future__ import annotations

import signal

from hypothesis import settings

signal.signal(signal.SIGINT, signal.default_int_handler)

settings.register_profile("kinsym", deadline=None, derandomize=True)
settings.load_profile("kinsym")
