"""Modules that need other libraries are no tests: they run in an environment of their own."""

collect_ignore_glob = ["peers/*"]
