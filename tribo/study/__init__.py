"""From one run to an answer: variants of a case, set side by side."""

from tribo.study.comparison import Comparison, compare, compare_files
from tribo.study.variation import Axis, Variant, grid, variants

__all__ = ["Axis", "Comparison", "Variant", "compare", "compare_files", "grid", "variants"]
