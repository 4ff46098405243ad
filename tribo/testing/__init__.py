"""Conformance checks for plugins, and closed-form solutions in `tribo.closed_forms`."""

from tribo.testing.kit import Outcome, Report, check, parametrize_checks

__all__ = ["Outcome", "Report", "check", "parametrize_checks"]
