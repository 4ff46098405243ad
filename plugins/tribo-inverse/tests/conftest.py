"""No run of a calibration is made twice in a file of tests."""

import pytest

from tribo_inverse.calibration.setups import make_run


@pytest.fixture(scope="module", autouse=True)
def kept_runs():
    kept = {}

    def remembered(tables, parameters, values, wanted, *rest):
        key = repr((tables, [each.path for each in parameters], values.tobytes(), wanted))
        if key not in kept:
            kept[key] = make_run(tables, parameters, values, wanted, *rest)
        return kept[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("tribo_inverse.calibration.experiment.make_run", remembered)
        yield
