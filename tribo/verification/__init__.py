"""What `tribo verify` runs: validation cases, and the study of a user's own case.

A case is a folder with `case.toml`, or a script, and `expected.toml`: those of the kernel lie in
`cases`. `expected` reads what a case must give, `validation` runs and judges it, `suite` collects
the cases of the kernel and of packages. `refinement` estimates the errors of grid and steps.
"""
