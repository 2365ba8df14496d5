"""The derivation: pool of equations, rules, search, plan (lecture, sections 3.4 to 3.6)."""
