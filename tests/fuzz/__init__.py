"""Robot files made up by a fuzzer that sees which lines of kinsym they reach."""
