"""What a table of a case shows of itself, and how it is made."""

import linecache

import pytest
from pydantic import Field
from pydantic.json_schema import SkipJsonSchema

from tribo import Archard, Body, Flat, Material, Sphere
from tribo.core.table import Table, descriptions
from tribo.core.units import parse, stated

STEEL = Material(young="207 GPa", poisson=0.3)


def test_repr_leaves_defaults_out():
    assert repr(Archard(k=1e-15)) == "Archard(k=1e-15)"


def test_repr_shows_what_is_inside():
    body = Body(surface=Flat(), material=STEEL)
    material = "Material(young=207000000000.0, poisson=0.3)"
    assert repr(body) == f"Body(surface=Flat(), material={material})"


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
