"""C in single precision: ``test_*.py`` take a few arms, ``python -m tests.single`` every robot of the gallery."""
