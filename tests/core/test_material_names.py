"""A material may be given by its name, and each number that is known has its source."""

import json
import tomllib

import pytest

import tribo
from tribo import CaseError
from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings
from tribo.core.material import Material, materials
from tribo.core.units import quantities
from tribo.templates import template

BALL = tomllib.loads(template("ball_on_disk"))
KNOWN = {name: table for name, table in materials.tables().items() if "." not in name}


def material_of_ball(given, **tables):
    case = validate_case({**apply_settings(BALL, {"bodies.ball.material": given}), **tables})
    return case.bodies["ball"].material


@pytest.mark.parametrize("name", KNOWN)
def test_its_numbers_are_usual_and_lie_in_their_ranges(name):
    material = tribo.materials[name]
    for key, number in KNOWN[name].items():
        if isinstance(number, dict):
            assert all(number["sources"])
        for mark in quantities(Material.model_fields[key]) if key in Material.model_fields else ():
            ends = [mark.read(end) for end in number.get("range", [number.get("value")])]
            assert min(ends) <= getattr(material, key) <= max(ends)
            assert mark.doubt(getattr(material, key)) is None


@pytest.mark.parametrize(
    "wrong", [{"poisson": -1}, {"poisson": 0.5}, {"poisson": float("nan")}, {"young": 0}]
)
def test_its_numbers_are_bounded_by_physics(wrong):
    with pytest.raises(CaseError):
        Material(**{"young": 1e9, "poisson": 0.3, **wrong})


def test_no_two_materials_share_a_name():
    names = [n.casefold() for name, table in KNOWN.items() for n in (name, *table.get("also", ()))]
    assert len(names) == len(set(names))


def test_other_names_stand_for_the_same_material():
    steel = tribo.materials["100Cr6"]
    assert steel == tribo.materials["52100"] == tribo.materials["suj2"]
    assert (steel.young, steel.poisson, steel.hardness) == (210e9, 0.3, 746 * 9806650.0)
    # Of numbers without a value, the middle of their range.
    assert tribo.materials["PTFE"].young == 600e6


def test_an_override_changes_a_named_material():
    tables = apply_settings(BALL, {"bodies.ball.material": "100Cr6"})
    tables = apply_settings(tables, ["bodies.ball.material.young=200 GPa"])
    assert tables["bodies"]["ball"]["material"] == {"name": "100Cr6", "young": "200 GPa"}
    material = validate_case(tables).bodies["ball"].material
    assert (material.young, material.hardness) == (200e9, 746 * 9806650.0)


def test_another_name_has_numbers_of_its_own():
    case = validate_case(apply_settings(BALL, {"bodies.ball.material": "100Cr6"}))
    changed = case.with_values(
        {"bodies.ball.material.density": 1e3, "bodies.ball.material.name": "C45"}
    )
    expected = tribo.materials["C45"].model_copy(update={"density": 1e3})
    assert changed.bodies["ball"].material == expected


def test_a_case_names_materials_of_its_own():
    own = {"mine": {"name": "PTFE", "young": "1 GPa"}}
    found = material_of_ball({"name": "mine", "density": 2000}, materials=own)
    assert (found.name, found.young, found.poisson, found.density) == ("mine", 1e9, 0.46, 2000.0)


def test_a_change_of_a_material_of_the_case_reaches_its_bodies():
    tables = apply_settings(BALL, {"bodies.ball.material": {"name": "mine", "density": 2000}})
    case = validate_case({**tables, "materials": {"mine": {"young": 1e9, "poisson": 0.4}}})
    soft = case.with_values({"materials.mine.young": 1e8}).bodies["ball"].material
    assert (soft.young, soft.poisson, soft.density) == (1e8, 0.4, 2000.0)


def test_a_result_keeps_name_and_numbers_of_a_material_that_is_known_no_more():
    case = validate_case(apply_settings(BALL, {"bodies.ball.material": "WC"}))
    data = json.loads(case.model_dump_json())
    data["bodies"]["ball"]["material"]["name"] = "gone.WC"
    again = validate_case(data).bodies["ball"].material
    assert again == case.bodies["ball"].material.model_copy(update={"name": "gone.WC"})


def test_a_name_that_is_no_text_is_refused():
    with pytest.raises(CaseError) as caught:
        material_of_ball({"name": ["WC"], "young": 1e9, "poisson": 0.3})
    assert caught.value.path == "bodies.ball.material.name"


@pytest.mark.parametrize("given", ["100Cr5", {"name": "100Cr5", "hardness": 1e9}])
def test_an_unknown_name_is_refused_with_near_ones(given):
    with pytest.raises(CaseError, match=r"'100Cr5'.*'100Cr6'\?") as caught:
        material_of_ball(given)
    assert caught.value.path == "bodies.ball.material"


def test_a_package_offers_materials_in_a_file_and_is_left_out_if_that_is_wrong(
    tmp_path, monkeypatch
):
    assert tribo.materials["uhmwpe.CoCrMo"].poisson == 0.29
    wrong = tmp_path / "materials.toml"
    wrong.write_text("[steel]\nyoung = 1\n")
    monkeypatch.setattr("tribo.registry.registry.material_files", lambda: [wrong])
    with pytest.warns(tribo.TriboWarning, match="materials.toml is left out"):
        assert tribo.materials["WC"].poisson == 0.24
