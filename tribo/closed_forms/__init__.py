"""Closed-form solutions, as small pure functions: oracles for tests, and of use by themselves.

One subject a file: Hertz contact in `hertz`, rigid indenters in `punch` and `cone`, waves in
`sinusoid`, an elastic foundation in `winkler`; worn bodies in `ball_wear`, `punch_wear` and
`ball_on_track`.
"""
