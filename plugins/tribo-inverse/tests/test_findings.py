"""What is to be known of a case before it runs."""

from paper_models import small

from tribo_inverse.adjoint.sensitivity import Sensitivity, of_case


def test_influences_below_the_error_of_the_grids_are_named_alone(monkeypatch):
    percent = {"load.normal": 1.0, "bodies.ball.wear.k": 0.2}
    found = Sensitivity("ball", "depth", percent, dict.fromkeys(percent, 0.3), percent)
    monkeypatch.setattr("tribo_inverse.adjoint.sensitivity.sensitivity", lambda *given: found)
    load, left_out = of_case(small(), 1e-4)
    assert (load.place, load.value, load.uncertainty) == ("load.normal", 1.0, 0.3)
    assert "volume +1.00 %" in load.words
    assert left_out.value is None
    assert left_out.words.endswith("bodies.ball.wear.k")
