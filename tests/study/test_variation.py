"""Axes are read as they were meant, and no variant fails over its input once others have run."""

import tomllib

import pytest

from tribo.core.errors import CaseError
from tribo.study.variation import points_of, read_axes, short_labels, variants
from tribo.templates import template

DATA = tomllib.loads(template("ball_on_disk")) | {"grid": {"size": "2 mm", "cells": 16}}


def made(*axes):
    return variants(DATA, points_of(read_axes(axes)))


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("a.b=winkler,dcfft", ("winkler", "dcfft")),
        ("a.b = 50 N, 100", ("50 N", 100)),
        ("a.b=1e-16,2", (1e-16, 2)),
        ("a.b=['1,5 N','x']", ("1,5 N", "x")),
        ("a.b=[[32, 64], 32]", ([32, 64], 32)),
        ('a.b=[{type="x"}, "y"]', ({"type": "x"}, "y")),
        ("a.b=one", ("one",)),
    ],
)
def test_an_axis_is_a_path_and_its_values(text, values):
    assert read_axes([text]) == {"a.b": values}


def test_a_variant_is_the_case_with_its_settings_and_the_defaults_of_another_type():
    found = made("contact.type=winkler,dcfft", "load.normal=50 N", "contact.plasticity=false")
    winkler, dcfft = found.values()
    assert next(iter(found)) == "contact.type=winkler, load.normal=50 N, contact.plasticity=false"
    assert (winkler.contact.type, dcfft.contact.type) == ("winkler", "dcfft")
    assert (winkler.contact.plasticity, winkler.contact.modulus) == (False, None)
    assert winkler.load.normal == 50.0
    assert winkler.bodies == dcfft.bodies


@pytest.mark.parametrize(
    ("axis", "label"),
    [
        ('contact=[{type="winkler", match="approach"}]', "contact=winkler match=approach"),
        ("output.save_times=[[0, 100]]", "output.save_times=[0, 100]"),
    ],
)
def test_values_are_labelled_as_they_are_written(axis, label):
    assert list(made(axis)) == [label]


def test_values_alone_are_the_labels_where_the_paths_are_the_same():
    both_vary = [
        {"load.normal": "120 N", "contact": "winkler"},
        {"load.normal": 100, "contact": "winkler"},
    ]
    assert short_labels(both_vary) == ["120 N, winkler", "100, winkler"]
    apart = [{"load.normal": 120}, {"contact.type": "winkler"}]
    assert short_labels(apart) == ["load.normal=120", "contact.type=winkler"]


@pytest.mark.parametrize(
    ("axes", "message"),
    [
        (["load.normal"], "'load.normal' is not of the form"),
        (["load..normal=1"], "'load..normal' is not a path"),
        (["load.normal=[]"], "load.normal: a value is missing"),
        (["load.normal=1,,2"], "load.normal: a value is missing"),
        (["load.normal=[1,"], "load.normal: '[1,' is not TOML"),
        (["load.normal=1,2", 'load."normal"=3'], 'load."normal": varies twice'),
        (["load.normal=50,50 N"], "load.normal=50 and load.normal=50 N are the same case"),
        (["loda.normal=1,2"], "did you mean 'load'?"),
        (["bodies.bal.wear.k=1,2"], "two bodies, as [bodies.ball] and [bodies.disk]; given: "),
        (["contact.type=winklr,dcfft"], "did you mean 'winkler'?"),
        (["load.normal=['1 N,2 N']"], "with load.normal=1 N,2 N: load.normal: '1 N,2 N': "),
        (["load.normal=1 N,2 Pa"], "with load.normal=2 Pa: load.normal: '2 Pa'"),
        # It is only when the parts are joined that this one is found.
        (
            ["kinematics.swept=disk,dsk"],
            "with kinematics.swept=dsk: kinematics.swept: there is no",
        ),
    ],
)
def test_what_is_wrong_is_said_before_anything_runs(axes, message):
    with pytest.raises(CaseError) as caught:
        made(*axes)
    assert message in str(caught.value)
