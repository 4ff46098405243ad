"""The report in real browsers."""

import re
from importlib.resources import files

import pytest
from browsers import browser, missing
from made_results import made

import tribo_report
from tribo_report.page import stills

pytestmark = pytest.mark.slow
SHOWN = "document.getElementById('said').textContent"
DRAWN = """JSON.stringify(
    [...document.querySelectorAll(".plot")].map(p => p.data?.[0]?.z ?? p.data?.[0]?.y)
)"""
ARROW_LEFT = "\ue012"


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    place = tmp_path_factory.mktemp("browsers") / "report.html"
    with pytest.MonkeyPatch.context() as patch:
        # One picture for paper: they take the most time, and all are alike.
        one = lambda pictures: stills(dict([*pictures.items()][:1]))  # noqa: E731
        patch.setattr("tribo_report.result.stills", one)
        with made(times=(0.0, 200.0, 3600.0), relief=2e-8) as result:
            return tribo_report.write_report(result, place)


@pytest.fixture(scope="module", params=["chromium", "firefox"])
def page(request, report):
    if lack := missing(request.param):
        pytest.skip(lack)
    with browser(request.param) as opened:
        opened.open(report.as_uri())
        opened.wait("document.documentElement.dataset.ready")
        yield opened


def test_the_slider_moves_maps_and_sections_by_the_keyboard(page):
    assert page.run(SHOWN) == "3600 s, 360 m"
    before = page.run(DRAWN)
    page.run("document.getElementById('save').focus()")
    page.press(ARROW_LEFT)
    page.wait(f"{SHOWN} === '200 s, 20 m'")
    after = page.run(DRAWN)
    assert after != before
    label = page.run("document.querySelector('#maps .plot').getAttribute('aria-label')")
    assert re.match("Contact pressure, map seen from above at 200 s, 20 m: largest .* MPa", label)


def test_history_goes_against_time_too(page):
    title = "document.querySelector('#history .plot').layout.xaxis.title.text"
    assert page.run(title) == "Sliding distance (m)"
    page.run("document.querySelector('#against label:last-child input').click()")
    page.wait(f"{title} === 'Time (s)'")


def test_buttons_turn_the_worn_surface_or_the_report_says_what_to_do(page):
    eye = "document.querySelector('#surface .plot')?._fullLayout.scene.camera.eye"
    before = page.run(eye)
    if before is None:
        said = page.run("document.getElementById('surface').textContent")
        assert "its WebGL is off. Turn on hardware acceleration" in said
        return
    page.run("document.querySelector('[data-turn]').click()")
    page.wait(f"{eye}.x !== {before['x']}")


def test_an_accessibility_checker_finds_nothing(page):
    axe = (files("axe_core_python") / "axe.min.js").read_text(encoding="utf-8")
    page.run(f"(() => {{ {axe}\nreturn 1; }})()")
    found = page.run(
        "axe.run().then(r => r.violations.map(v => [v.id, v.nodes.map(n => n.html.slice(0, 200))]))"
    )
    assert found == []


def test_a_phone_shows_it_without_scrolling_sideways(page, report):
    page.open(report.as_uri(), width=400)
    page.wait("document.documentElement.dataset.ready")
    # What varies in a sweep has names of its own.
    page.run(
        "document.querySelectorAll('#against label').forEach(l => l.append(' of a long name'))"
    )
    assert page.run("document.documentElement.scrollWidth <= innerWidth")


def test_nothing_is_asked_of_the_network_and_the_console_is_silent(page):
    own = ("file:", "data:", "blob:", "about:", "chrome:")
    assert [url for url in page.requests if not url.startswith(own)] == []
    assert page.console == []
