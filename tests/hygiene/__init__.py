"""Generated C under hostile input, sanitizers and threads: ``test_c_hygiene.py`` takes an arm of each kind,
``python -m tests.hygiene`` the gallery."""
