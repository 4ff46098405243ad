"""What a table of a case shows of itself, and how it is made."""

import linecache

import pytest
from pydantic import Field
from pydantic.json_schema import SkipJsonSchema

from tribo import Archard, Body, Flat, Grid, Load, Material, Output, Sphere
from tribo.core.table import Table, descriptions
from tribo.core.units import parse, stated

STEEL = Material(young="207 GPa", poisson=0.3)


def test_repr_leaves_defaults_out():
    assert repr(Archard(k=1e-15)) == "Archard(k=1e-15)"


def test_repr_shows_what_is_inside():
    body = Body(surface=Flat(), material=STEEL)
    material = "Material(young=207000000000.0, poisson=0.3)"
    assert repr(body) == f"Body(surface=Flat(), material={material})"


def test_a_notebook_shows_keys_with_units():
    shown = Body(surface=Flat(), material=STEEL, wear=Archard(k=1e-15))._repr_html_()
    assert "<caption>Body</caption>" in shown
    assert "<td>young</td><td>207 GPa</td>" in shown
    assert "<td>k</td><td>1e-15 1/Pa</td>" in shown


def test_a_notebook_shows_pairs():
    assert "<td>2 mm × 1 mm</td>" in Grid(("2 mm", "1 mm"), 8)._repr_html_()


def test_a_notebook_shows_lists():
    assert "<td>500 s, 1500 s, 0 s</td>" in Output(save_times=(500, 1500, 0))._repr_html_()
    stages = ({"normal": 5, "until": 9}, {"normal": 6, "until": 12})
    assert "</table>, <table>" in Load(normal=stages)._repr_html_()


@pytest.mark.parametrize(
    ("given", "unit", "shown"),
    [
        ("207.123456789 GPa", "Pa", "207.123456789 GPa"),
        ("0.3 µm", "m", "300 nm"),
        ("1.2345678e-6 mm^3/(N m)", "1/Pa", "1.2345678e-15 1/Pa"),
    ],
)
def test_a_value_is_stated_with_the_digits_that_it_was_given(given, unit, shown):
    assert stated(parse(given, unit), unit) == shown


def test_values_without_names_are_refused_in_plain_words():
    with pytest.raises(TypeError, match=r"value of Sphere by its name, as Sphere\(radius=…\)"):
        Sphere(5e-3)


def test_a_table_typed_into_a_notebook_has_the_descriptions_of_its_keys():
    cell = "class Typed(Table):\n    k: float\n    'Of wear.'\n    def rate(self): ...\n"
    linecache.cache["<cell>"] = len(cell), None, cell.splitlines(keepends=True), "<cell>"
    names = {"Table": Table, "__name__": "no module"}
    exec(compile(cell, "<cell>", "exec"), names)
    assert descriptions(names["Typed"]) == {"k": "Of wear."}


def test_a_schema_has_the_descriptions_by_the_keys_that_it_has():
    class Hidden(Table):
        k: float = Field(1.0, alias="lambda")
        """Of wear."""
        unseen: SkipJsonSchema[int] = 0
        """Of nobody."""

    keys = Hidden.model_json_schema()["properties"]
    assert {name: each["description"] for name, each in keys.items()} == {"lambda": "Of wear."}
