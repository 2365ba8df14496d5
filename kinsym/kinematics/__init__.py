"""What the lecture states: link transforms, the chain, forward kinematics, the Jacobian."""
