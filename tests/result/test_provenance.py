"""Where each model of a result came from, and when it counts as another."""

from typing import ClassVar

import pytest
from edited import edited
from paper_models import archard, flat, named, small, steel

from tribo import CaseError, Simulation
from tribo.result.provenance import changed_components, origin, provenance
from tribo.surfaces.forms import Sphere


class Stated(Sphere):
    """A sphere that states what it was read from."""

    serial: ClassVar[str] = "7"

    def facts(self):
        return {"serial number": self.serial}


def stated():
    return Stated(radius="5 mm")


def model():
    bodies = [named("ball", stated(), steel(), archard()), named("disk", flat(), steel())]
    return small(bodies=bodies, save_times=(20,))


def made(**changes):
    before = provenance({"contact": origin(archard())})
    before["components"]["contact"].update(changes)
    return before


def test_being_editable_is_no_change():
    assert changed_components(made(editable=False), made(editable=True)) == []


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"version": "9.9"}, "version 9.9"),
        ({"class": "other.Law", "distribution": "fork"}, "class other.Law, distribution fork"),
        ({"code": "abcdef0123456789"}, "code abcdef0123"),
        ({"facts": {"sha256": "beef"}}, "facts sha256 beef"),
    ],
)
def test_a_change_is_told_by_what_differs(changes, words):
    ((place, old, new),) = changed_components(made(), made(**changes))
    assert place == "contact"
    assert new == words
    assert old != new


def test_a_component_more_or_less_is_a_change():
    fewer = made()
    del fewer["components"]["contact"]
    ((_, old, _),) = changed_components(fewer, made())
    assert old == "not there"


def test_a_run_does_not_go_on_with_another_file_behind_its_surface(tmp_path, monkeypatch):
    path = tmp_path / "stopped.h5"
    Simulation(model().case).run(path).close()
    # As if it had been stopped.
    with edited(path) as file:
        file.attrs["status"] = "interrupted"
    monkeypatch.setattr(Stated, "serial", "8")
    with pytest.raises(CaseError, match=r"was facts serial number 7, is facts .*number 8"):
        Simulation(model().case).resume(path)
