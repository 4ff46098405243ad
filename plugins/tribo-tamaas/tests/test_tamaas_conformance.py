"""The conformance checks of tribo."""

import pytest
from tribo.testing import parametrize_checks

from tribo_tamaas import Tamaas

pytest.importorskip(
    "tamaas", reason="tamaas is not installed: it has wheels for Linux on x86-64 only"
)

test_conformance = parametrize_checks(Tamaas, configs=[{}])
