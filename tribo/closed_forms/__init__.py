"""Closed-form solutions that runs, examples and pages compare with, as small pure functions.

Those that only a validation case compares with stand as equations in its `expected.toml`.
"""
