"""Laws of kinematics over random robots: ``test_laws.py`` tries a few of each, ``python -m tests.laws`` many more."""
