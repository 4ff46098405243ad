"""Conformance checks for plugins, and closed-form solutions in `tribo.closed_forms`."""

from tribo.testing.kit import check, example_configs, parametrize_checks
from tribo.testing.report import Outcome, Report

__all__ = ["Outcome", "Report", "check", "example_configs", "parametrize_checks"]
