"""What `tribo verify` runs: closed forms, limits, brute force, other codes.

A check is a function from a level (cells, steps) to what was expected and what
was got; `suite.CHECKS` lists them all. `study` finds the errors of grid and
steps in a case of the user's own.
"""
