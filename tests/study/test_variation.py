"""Axes are read as they were meant, and no variant fails over its input once others have run."""

import tomllib

import pytest

from tribo.core.errors import CaseError
from tribo.study.variation import grid, read_axes, variants
from tribo.templates import template

DATA = tomllib.loads(template("ball_on_disk")) | {"grid": {"size": "2 mm", "cells": 16}}


def made(*axes):
    return variants(DATA, grid(read_axes(axes)))


def refused(*axes):
    with pytest.raises(CaseError) as caught:
        made(*axes)
    return str(caught.value)


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("a.b=winkler,dcfft", ("winkler", "dcfft")),
        ("a.b = 50 N, 100", ("50 N", 100)),
        ("a.b=1e-16,2", (1e-16, 2)),
        ("a.b='1,5 N','x'", ("1,5 N", "x")),
        ("a.b=[1, 2]", (1, 2)),
        ("a.b=[[32, 64], 32]", ([32, 64], 32)),
        ('a.b=[{type="x"}, "y"]', ({"type": "x"}, "y")),
        ("a.b=one", ("one",)),
        ('a.b={type="x", c=1}', ({"type": "x", "c": 1},)),
    ],
)
def test_an_axis_is_a_path_and_its_values(text, values):
    assert read_axes([text]) == {"a.b": values}


@pytest.mark.parametrize("quoted", ["'50 N,100 N'", '"50 N,100 N"'])
def test_quotes_around_all_values_are_told(quoted):
    with pytest.raises(CaseError) as caught:
        read_axes([f"load.normal={quoted}"])
    assert str(caught.value) == (
        f"load.normal: its quotes make one value of {quoted}; leave them out, or give each value "
        "its own"
    )
    assert read_axes([f"load.normal=[{quoted}]"])["load.normal"] == ("50 N,100 N",)


def test_lists_are_labelled_as_they_are_written():
    assert list(made("output.save_times=[[0, 100], [0, 200]]")) == [
        "output.save_times=[0, 100]",
        "output.save_times=[0, 200]",
    ]


def test_axes_multiply_and_the_last_varies_first():
    assert grid({"a": (1, 2), "b": ("x", "y")}) == [
        {"a": 1, "b": "x"},
        {"a": 1, "b": "y"},
        {"a": 2, "b": "x"},
        {"a": 2, "b": "y"},
    ]


def test_a_variant_is_the_case_with_its_settings():
    found = made("load.normal=50 N,80")
    assert list(found) == ["load.normal=50 N", "load.normal=80"]
    first, second = found.values()
    assert (first.load.normal, second.load.normal) == (50.0, 80.0)
    assert first.bodies == second.bodies


def test_another_type_comes_with_its_own_defaults():
    found = made("contact.type=winkler,dcfft", "contact.plasticity=false")
    winkler, dcfft = found.values()
    assert next(iter(found)) == "contact.type=winkler, contact.plasticity=false"
    assert winkler.contact.model_dump() == {
        "type": "winkler",
        "plasticity": False,
        "modulus": None,
        "layer": None,
        "match": None,
    }
    assert dcfft.contact.type == "dcfft"


def test_a_table_is_named_by_its_type_and_its_keys():
    assert list(made('contact=[{type="winkler", match="approach"}]')) == [
        "contact=winkler match=approach"
    ]


@pytest.mark.parametrize(
    ("axes", "message"),
    [
        (["load.normal"], "'load.normal' is not of the form path=values, as in contact.type="),
        (["load..normal=1"], "'load..normal' is not a path"),
        (["load.normal="], "load.normal: a value is missing; write"),
        (["load.normal=[]"], "load.normal: a value is missing; write"),
        (["load.normal=1,,2"], "load.normal: a value is missing; write"),
        (["load.normal=[1,"], "load.normal: '[1,' is not a list in TOML"),
        (["load.normal=1,2", 'load."normal"=3'], 'load."normal": varies twice'),
        (["load.normal=1,1"], "load.normal=1 and load.normal=1 are the same case"),
        (["load.normal=50,50 N"], "load.normal=50 and load.normal=50 N are the same case"),
        (["loda.normal=1,2"], "loda: unknown key 'loda'; did you mean 'load'?"),
        (["contact.typ=a,b"], "contact.typ: unknown key 'typ'; did you mean 'type'?"),
        (["bodies.bal.wear.k=1,2"], "there is no body 'bal'; did you mean 'ball'? The bodies are"),
        (["contact.type=winklr,dcfft"], "unknown contact solver 'winklr'; did you mean 'winkler'?"),
        (["load.normal.x=1,2"], "load.normal: a table is not a quantity"),
        (["load.normal=1 N,2 Pa"], "with load.normal=2 Pa: load.normal: '2 Pa' is a pressure"),
        # It is only when the parts are joined that this one is found.
        (["kinematics.swept=disk,dsk"], "with kinematics.swept=dsk: kinematics"),
    ],
)
def test_what_is_wrong_is_said_before_anything_runs(axes, message):
    assert message in refused(*axes)


def test_variants_with_one_reason_are_told_together():
    text = refused("load.normal=-1,-2,1", "grid.cells=16,32")
    assert text.splitlines()[0] == "4 of 6 variants cannot be run; nothing was started:"
    assert (
        "  with load.normal=-1, grid.cells=16; load.normal=-1, grid.cells=32: load.normal:" in text
    )
    assert len(text.splitlines()) == 3
    assert "; and 1 more: loda" in refused("loda=1,2,3,4")
    assert refused("loda=1").startswith("the only variant cannot be run; nothing was started:\n")
