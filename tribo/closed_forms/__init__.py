"""Closed-form solutions that runs, examples and pages compare with, as small pure functions.

Hertz contact in `hertz`, and a worn ball and its track in `ball_on_track`. Those that only a
validation case compares with stand as equations in its `expected.toml`.
"""
