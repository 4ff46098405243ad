"""Every validation case holds, uses what is installed, and can fail."""

import shutil

import pytest

from tribo.core.errors import CaseError
from tribo.verification.suite import cases_in, installed_cases, uncovered
from tribo.verification.validation import ValidationCase

CASES = installed_cases()


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_case_holds(case):
    rows = list(case.run())
    assert not [str(row) for row in rows if row.verdict == "fails"]


def test_every_installed_component_and_each_of_its_keys_is_used_by_a_case():
    assert uncovered(CASES) == []
    without = [case for case in CASES if case.name != "measured_path"]
    assert uncovered(without) == ["measured.duration"]


@pytest.fixture
def own(tmp_path):
    """A copy of a case, to be changed."""
    original = next(case for case in CASES if case.name == "archard_k").folder
    return ValidationCase(shutil.copytree(original, tmp_path / "own"))


def edit(case, name, old, new):
    path = case.folder / name
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def test_a_folder_of_ones_own_holds_and_a_changed_value_fails(own):
    (case,) = cases_in(own.folder.parent)
    assert [row.verdict for row in case.run()] == ["holds"]
    edit(own, "expected.toml", "value = [6.22e-07, 6.22e-07]", "value = ['0.622 um', 6.3e-7]")
    (row,) = cases_in(own.folder)[0].run()
    assert row.verdict == "fails"
    assert row.error == pytest.approx(0.08 / (6.22 + 6.3))
    for part in ("own", "wear depth of pin", "6.22e-07 m", "Archard (1953)"):
        assert part in str(row)


@pytest.mark.parametrize(
    ("old", "new", "place"),
    [
        ("tolerance = 1e-08", "tolerance = -1", "expect.1.tolerance"),
        ("quantity", "quantty", "expect.1"),
        ("value = [6.22e-07, 6.22e-07]", "value = 6.22e-7", "expect.1"),
        ('kind = "closed form"', 'kind = "mine"', "kind"),
        ("quick = true", 'levels = { "grid.cells" = [4, 8], "load.normal" = [1] }', "levels"),
    ],
)
def test_a_mistake_is_one_line_with_its_place(own, old, new, place):
    edit(own, "expected.toml", old, new)
    with pytest.raises(CaseError) as error:
        own.expected  # noqa: B018
    (line,) = str(error.value).splitlines()
    assert line.startswith(f"{own.folder / 'expected.toml'}: {place}")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('quantity = "wear_depth"', 'quantity = "wear_dept"', "expect.1: a result has no variable"),
        ('body = "pin"', 'body = "ball"', "pin, flat"),
        ('body = "pin"', "", "pin or flat"),
        ("value = [6.22e-07, 6.22e-07]", 'value = ["1 N", 0]', "1 N"),
        ("tolerance", "time = 3\ntolerance", "50 s"),
    ],
)
def test_what_a_result_does_not_have_fails_the_row_and_says_so(own, old, new, words):
    edit(own, "expected.toml", old, new)
    (row,) = own.run()
    assert (row.verdict, row.got) == ("fails", None)
    assert words in str(row)


def test_a_folder_without_a_case_is_refused(tmp_path):
    with pytest.raises(CaseError, match=r"expected\.toml"):
        cases_in(tmp_path)


def made(own, error, order="order = 2", tolerance=0.02):
    """Return a case of a script whose error over the levels is known."""
    (own.folder / "own.py").write_text(f"def found(n): return {{'x': 5.0 * (1 + {error})}}\n")
    (own.folder / "expected.toml").write_text(
        "title = 't'\nsource = 's'\nkind = 'measured'\npublished = true\n"
        "levels = { n = [10, 20, 40] }\n"
        f"[[expect]]\nquantity = 'x'\nvalue = 5.0\ntolerance = {tolerance}\nreason = 'r'\n{order}\n"
    )
    (row,) = ValidationCase(own.folder).run()
    return row


@pytest.mark.parametrize(
    ("error", "order", "verdict"),
    [
        ("20 / n**2", "order = 2", "holds"),
        ("-1 / n**2", "order = 2", "holds"),
        ("1 / n**1.7", "order = 2", "fails"),
        ("1 / n**2.3", "order = 2", "fails"),
        ("40 / n**2", "order = 2", "fails"),
        ("float('nan')", "order = 2", "fails"),
        # Without an error there is no order to be seen.
        ("0.0", "order = 2", "fails"),
        ("0.0", "", "holds"),
        ("1 / (n - n)", "", "fails"),
    ],
)
def test_a_row_holds_with_its_order_and_within_its_tolerance_only(own, error, order, verdict):
    assert made(own, error, order).verdict == verdict


def test_a_solver_that_is_missing_is_told_from_one_that_disagrees(own):
    edit(own, "expected.toml", "quick = true", 'solvers = ["no.such", "dcfft"]')
    verdicts = {row.solver: row.verdict for row in own.run()}
    assert verdicts == {"": "holds", "no.such": "not installed", "dcfft": "fails"}
