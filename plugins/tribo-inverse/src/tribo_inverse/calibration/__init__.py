"""Fit the coefficients of a case to measurements."""
