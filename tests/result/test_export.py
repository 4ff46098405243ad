"""Tables of a result in a laboratory's units, as CSV and for Excel."""

import sys

import pandas as pd
import pytest
from click.testing import CliRunner
from made_results import TIMES, written

from tribo import CaseError
from tribo.cli.export import export
from tribo.result.export import write_tables


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return written(tmp_path_factory.mktemp("made") / "made.h5")


def exported(path, *options):
    return CliRunner().invoke(export, [str(path), *options], catch_exceptions=False).output


def test_columns_are_in_the_units_of_their_headings(path, tmp_path):
    exported(path, "-d", str(tmp_path), "--columns", "time, p max,ball depth")
    lab = pd.read_csv(tmp_path / "lab.csv")
    exported(path, "-d", str(tmp_path))
    saves = pd.read_csv(tmp_path / "saves.csv")
    assert list(lab) == ["time (s)", "p max (MPa)", "ball depth (µm)"]
    assert list(lab["time (s)"]) == list(TIMES)
    for own, si, factor in (
        ("p max (MPa)", "max_pressure_Pa", 1e-6),
        ("ball depth (µm)", "bodies.ball.max_wear_depth_m", 1e6),
    ):
        assert list(lab[own]) == pytest.approx(list(factor * saves[si]), rel=1e-12, abs=0)


def test_excel_has_the_tables_of_the_csv_files(path, tmp_path):
    exported(path, "-d", str(tmp_path))
    exported(path, "-d", str(tmp_path), "--format", "xlsx")
    sheets = pd.read_excel(tmp_path / "tables.xlsx", sheet_name=None, na_values="nan")
    files = {file.stem: pd.read_csv(file) for file in tmp_path.glob("*.csv")}
    assert sheets.keys() == files.keys()
    for name, sheet in sheets.items():
        pd.testing.assert_frame_equal(sheet, files[name], check_dtype=False, rtol=1e-12)


def test_an_unknown_column_is_refused_with_those_there_are(path):
    with pytest.raises(CaseError, match=r"'depth'.* time, path, p max,"):
        exported(path, "--columns", "time,depth")


def test_a_table_longer_than_a_sheet_of_excel_is_refused(tmp_path):
    with pytest.raises(CaseError, match="2²⁰ rows at most"):
        write_tables({"history": {"time_s": range(2**20)}}, tmp_path, "xlsx")


def test_excel_without_openpyxl_names_what_to_install(path, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "openpyxl.workbook", None)
    with pytest.raises(CaseError, match="pip install openpyxl"):
        exported(path, "--format", "xlsx", "-d", str(tmp_path))
