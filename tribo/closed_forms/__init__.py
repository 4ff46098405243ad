"""Closed-form solutions that runs and pages compare with, as small pure functions."""
