"""What a table of a case shows of itself, and how it is made."""

import pytest

from tribo import Archard, Body, Flat, Grid, Material, Sphere

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
    assert "<td>young</td><td>207000000000.0 Pa</td>" in shown
    assert "<td>k</td><td>1e-15 1/Pa</td>" in shown


def test_a_notebook_shows_pairs():
    assert "0.002 × 0.001 m" in Grid(("2 mm", "1 mm"), 8)._repr_html_()


def test_values_without_names_are_refused_in_plain_words():
    with pytest.raises(TypeError, match=r"value of Sphere by its name, as Sphere\(radius=…\)"):
        Sphere(5e-3)
