"""What is to be known of a case before it runs."""

from tribo_inverse.adjoint.sensitivity import influences


def test_influences_below_the_error_of_the_grids_are_left_out():
    coarse = {"load.normal": 1.3, "bodies.ball.wear.k": 0.5, "friction.coefficient": 0.1}
    fine = {"bodies.ball.wear.k": 0.2, "load.normal": 1.0, "bodies.ball.material.young": 0.5}
    (load,) = influences("depth", coarse, fine)
    assert (load.place, load.value) == ("load.normal", 1.0)
    assert round(load.uncertainty, 9) == 0.3
    assert "depth +1.00 ± 0.30 %" in load.words
