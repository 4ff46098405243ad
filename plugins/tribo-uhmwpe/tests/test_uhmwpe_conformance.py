"""The checks of tribo that every wear law has to pass."""

from tribo.testing import parametrize_checks

from tribo_uhmwpe.cross_shear import CrossShear

test_cross_shear = parametrize_checks(CrossShear)
