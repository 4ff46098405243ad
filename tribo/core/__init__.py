"""Values every part shares: grid, contact problem, state, units, errors."""
