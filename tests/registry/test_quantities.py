"""Numbers that a package reads off a result stand in every table, without a word in the case."""

import sys

import pandas
import pytest
import sweeps
from made_results import made
from paper_models import K

from tribo import Column, Registry, Result, TriboWarning, compare, hookimpl, sweep
from tribo.lab.report import lab_report, lab_sentences, quantity_rows
from tribo.registry import registry as registries
from tribo.registry.plugin_file import add_files
from tribo.registry.registry import default_registry
from tribo.study.side_by_side import comparison_table

FILE = """
from math import nan
from tribo import Column, hookimpl

def lost(result, body):
    return result.saves()[-1]["bodies"][body]["wear_volume_m3"]

@hookimpl
def tribo_quantities():
    return [
        Column("slid", "m", "path", lambda result: result.distances[-1]),
        Column("lost", "m^3", "volume", lost, of_bodies=True),
        Column("unknown", "1", "what is not there", lambda result: nan),
    ]
"""
SLID, LOADS = 1.0, (50.0, 60.0)
"""In 10 s at 0.1 m/s, in m, and loads in N: those of `sweeps`."""
LOST = [K * load * SLID for load in LOADS]
"""By Archard's law, in m³."""


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """A sweep over two loads, while a file with quantities takes part."""
    folder = tmp_path_factory.mktemp("read")
    (folder / "read.py").write_text(FILE)
    default_registry.cache_clear()
    add_files([folder / "read.py"])
    yield sweep(sweeps.case(folder), sweeps.LOADS, executor=sweeps.Inline())
    sys.modules.pop("plugin_read")
    default_registry.cache_clear()


@pytest.fixture
def compared(swept):
    with compare([run.path for run in swept.runs], labels=["light", "heavy"]) as comparison:
        yield comparison


def test_a_sweep_has_a_column_for_each(swept):
    runs = pandas.read_csv(swept.folder / "runs.csv").filter(like="quantities.")
    assert {*runs} == {f"quantities.{key}" for key in ("slid_m", "ball.lost_m3", "disk.lost_m3")}
    assert list(runs["quantities.slid_m"]) == pytest.approx([SLID] * 2)
    for body in ("ball", "disk"):
        lost = list(runs[f"quantities.{body}.lost_m3"])
        assert lost == pytest.approx(LOST, rel=1e-9, abs=0)


def test_a_lab_table_has_a_row_for_each(swept):
    with Result.open(swept.runs[0].path) as result:
        lab = lab_report(result)
        sentences = [*lab_sentences(result, lab)]
    assert "path: 1 m" in sentences
    assert f"volume of disk: {1e14 * LOST[0]:.4g} 10⁻⁵ mm³" in sentences
    assert lab.as_json()["plugins"][0]["key"] == "quantities.slid_m"


def test_a_comparison_has_a_row_for_each_in_table_and_json(compared):
    for result, lost in zip(compared.as_json()["results"].values(), LOST, strict=True):
        assert result["quantities"]["quantities.slid_m"] == pytest.approx(SLID)
        found = result["quantities"]["quantities.ball.lost_m3"]
        assert found == pytest.approx(lost, rel=1e-9, abs=0)
    rows = {row.values[0]: row.values[1:] for row in comparison_table(compared, [0.0]).rows}
    assert rows["path, m"] == pytest.approx((SLID, SLID))
    (name,) = (name for name in rows if name.startswith("volume of ball"))
    assert name == "volume of ball, 10⁻⁵ mm³"
    assert rows[name] == pytest.approx([1e14 * lost for lost in LOST], rel=1e-9)


class Reads:
    """A package whose quantities are read by these functions."""

    def __init__(self, **columns):
        self.columns = columns

    @hookimpl
    def tribo_quantities(self):
        return [Column(name, "1", name, read) for name, read in self.columns.items()]


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"bad": lambda result: 1 / 0}, "ZeroDivisionError"),
        ({"good": lambda result: 2.0}, "another package has a quantity"),
    ],
    ids=["raises", "has a name that is taken"],
)
def test_a_package_whose_quantity_cannot_be_had_is_left_out_and_no_other(monkeypatch, wrong, words):
    both = Registry.with_plugins(Reads(good=lambda result: 1.0), Reads(**wrong))
    monkeypatch.setattr(registries, "default_registry", lambda: both)
    (name,) = wrong
    with pytest.warns(TriboWarning, match=rf"quantities\.{name} is left out.*{words}"):
        (row,) = quantity_rows(made(times=(0.0,)))
    assert (row.label, row.value) == ("good", 1.0)
