"""Fit the coefficients of a case to what was measured."""
