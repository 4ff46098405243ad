"""The validation cases of `tribo verify`, and the refinement of a user's own case.

A case is a folder with `case.toml`, or a script, and `expected.toml`; the kernel's cases lie in
`cases`. `expected` reads the expected numbers, `validation` runs and judges a case, `suite`
collects the cases of the kernel and of packages. `refinement` estimates the errors of grid and
steps.
"""
