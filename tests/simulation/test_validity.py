"""What check and the run say where a case leaves what its models hold for."""

import pytest
from paper_models import archard, pin

from tribo import Grid, Result, Simulation, TriboWarning
from tribo.contact.periodic import Periodic
from tribo.contact.winkler import FoundationLayer, Winkler
from tribo.core.errors import OutOfWindow, TooWorn
from tribo.motion.closed_track import Unidirectional
from tribo.simulation.predict import predict


def sliding(metres, k, **changes):
    """A square pin of 2 mm under 10 MPa: its depth is 1e7 Pa k s, its specific wear rate is k."""
    motion = Unidirectional(speed="0.1 m/s", track_length="8 mm", distance=metres)
    return pin(archard(k), kinematics=motion, **changes)


@pytest.mark.parametrize(
    ("metres", "k", "kind", "limit"),
    [(1, 3e-11, "depth", 0.2e-3), (1e-3, 2e-9, "wear rate", 1e-9)],
)
def test_implausible_wear_is_warned_of_once_with_its_place_and_time(metres, k, kind, limit):
    model = sliding(metres, k)
    with pytest.warns(TriboWarning, match=f"{kind}: at ") as warned:
        result = Simulation(model).run()
    (found,) = result.findings
    assert (found.kind, found.place, found.limit) == (kind, "bodies.pin", limit)
    assert found.value > found.limit
    assert 0 < found.time < metres / 0.1
    assert 0 < found.distance < metres
    assert len(warned) == 1
    assert result.status == "done"
    assert [(each.kind, each.limit) for each in predict(model).problems] == [(kind, limit)]


@pytest.mark.filterwarnings("ignore::tribo.TriboWarning")
@pytest.mark.parametrize(
    ("metres", "k", "limit"), [(1, 5.2e8, 0.2e-3), (10, 3e-11, 0.2e-3), (1e-9, 2e-5, 1e-9)]
)
def test_impossible_wear_stops_a_run_and_a_check(tmp_path, metres, k, limit):
    model, path = sliding(metres, k), tmp_path / "pin.h5"
    with pytest.raises(TooWorn) as failure:
        Simulation(model).run(path)
    # A fit takes a shorter step there.
    assert isinstance(failure.value, OutOfWindow)
    stopped = failure.value.finding
    assert (stopped.place, stopped.limit) == ("bodies.pin", limit)
    assert stopped.value >= 10 * limit
    assert 0 < stopped.time < metres / 0.1
    with Result.open(path) as result:
        assert result.status == "failed"
        assert result.times[-1] < stopped.time
        last = result.findings[-1]
    assert (last.kind, last.place, last.value) == ("failed", "bodies.pin", stopped.value)
    assert predict(model).exit_code == TooWorn.exit_code == 3


def test_a_window_that_repeats_bounds_no_depth():
    repeats = {"contact": Periodic(), "grid": Grid((2e-3, 2e-3), (8, 8))}
    assert Simulation(sliding(10, 3e-11, **repeats, ends_at_window=False)).run().findings == ()


def test_a_thin_layer_on_a_stiff_base_bounds_the_depth():
    layer = FoundationLayer(thickness=0.1e-3, young=1e9, poisson=0.3)
    with pytest.warns(TriboWarning, match="depth: at "):
        (warned,) = Simulation(sliding(1, 2e-12, contact=Winkler(layer=layer))).run().findings
    assert warned.limit == 0.1 * layer.thickness
