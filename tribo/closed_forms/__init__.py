"""Closed-form solutions that runs, examples and pages compare with, as small pure functions.

Hertz contact in `hertz`, a worn ball and its track in `ball_on_track`, and the rates at which
punches wear to an even pressure in `punch_wear`. Those that only a validation case compares with
stand as equations in its `expected.toml`.
"""
