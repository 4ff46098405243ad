"""Closed-form solutions, as small pure functions: oracles for tests, and of use by themselves.

One subject a file. Hertz contact is in ``tribo.closed_forms.hertz``.
"""
