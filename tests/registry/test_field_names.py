"""A field whose name a file cannot hold is refused before anything is run."""

import pytest
from paper_models import flat, named, small, sphere, steel
from strangers.running_in import RunningIn

from tribo import Registry, TriboError
from tribo.plugin import Field, hookimpl

BAD = ["a/b", "", ".", "a b", "1st", "µ/m", "\x1b[31m", "a.b"]


def law(*names):
    fields = tuple(Field(name, "m", "Slid.") for name in names)
    return type("Slashed", (RunningIn,), {"state_fields": fields})


class Plugin:
    def __init__(self, *names):
        self.names = names

    @hookimpl
    def tribo_components(self):
        return [law(*self.names)]


@pytest.mark.parametrize("name", BAD)
def test_a_plugin_that_names_it_so_is_broken(name):
    with pytest.raises(
        TypeError, match=r"Slashed\.state_fields: .* cannot name a field"
    ) as refused:
        Registry.with_plugins(Plugin(name))
    assert repr(name) in str(refused.value)
    assert "letters, digits and underscores" in str(refused.value)


def test_a_plugin_that_names_two_alike_is_broken():
    with pytest.raises(TypeError, match="the field 'slip' is declared twice"):
        Registry.with_plugins(Plugin("slip", "slip"))


def test_a_model_of_objects_is_refused_too():
    wear = law("a/b")(k_first=9e-16, k_last=3e-16, length=20.0)
    bodies = [named("ball", sphere(), steel(), wear), named("disk", flat(), steel())]
    with pytest.raises(TriboError, match="of body 'ball', state_fields: 'a/b' cannot name"):
        small(bodies=bodies)
