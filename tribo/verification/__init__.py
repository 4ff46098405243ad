"""What `tribo verify` runs: closed forms, limits, brute force, other codes.

A `reference.Reference` is a problem with a known answer: a function from a
level (cells, steps) to rows of expected and computed values. `suite.REFERENCES`
lists them all. `refinement` estimates the errors of grid and steps in a user's case.
"""
