"""Nothing public is undocumented; links of pages lead to files; the site is short."""

import inspect
import re
from importlib import import_module
from pathlib import Path

import pytest

import tribo
import tribo.units
from tribo.component import Component
from tribo.core.table import descriptions
from tribo.registry import hookspecs
from tribo.registry.registry import Registry

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
# A build copies these pages into docs/.
BROUGHT = [*ROOT.glob("plugins/*/docs"), ROOT / "examples"]
COPIES = {DOCS / page.relative_to(place) for place in BROUGHT for page in place.rglob("*.md")}
FOLDERS = (DOCS, ROOT / "plugins", ROOT / "examples", ROOT / "benchmarks")
PAGES = {*ROOT.glob("*.md"), *(page for place in FOLDERS for page in place.rglob("*.md"))}
BUILT_IN = list(Registry.with_plugins().components.values())
HOOKS = [name for name in vars(hookspecs) if name.startswith("tribo_")]


@pytest.mark.parametrize("name", tribo.__all__)
def test_every_public_name_and_its_members_have_a_docstring(name):
    thing = getattr(tribo, name)
    if not (inspect.isclass(thing) or inspect.isfunction(thing)):
        return
    assert inspect.getdoc(thing), name
    if not inspect.isclass(thing) or not thing.__module__.startswith("tribo"):
        return
    for member, value in vars(thing).items():
        if member.startswith("_") or not (inspect.isfunction(value) or isinstance(value, property)):
            continue
        assert inspect.getdoc(value), f"{name}.{member}"


MODELS = {cls.__name__ for cls in BUILT_IN} & {*tribo.__all__}


@pytest.mark.parametrize("name", sorted(MODELS))
def test_every_built_in_model_is_on_the_page_on_python(name):
    assert f":: tribo.{name}\n" in (DOCS / "reference" / "python.md").read_text()


def test_every_unit_is_one_of_the_package_or_of_its_units():
    assert {"mm", "GPa", "N", "Hz", "hour"} <= {*tribo.__all__} & {*vars(tribo.units)}


@pytest.mark.slow
def test_the_page_of_public_names_is_up_to_date(monkeypatch):
    monkeypatch.syspath_prepend(DOCS / "support")
    names = import_module("public_names")
    up_to_date = names.PAGE.read_text(encoding="utf-8") == "\n".join(names.page())
    assert up_to_date, (
        f"docs/reference/plugin_api.md is not what is in the code; renew it: {names.COMMAND}"
    )


@pytest.mark.parametrize("hook", HOOKS)
def test_every_hook_is_documented_in_a_line_and_on_the_page_on_plugins(hook):
    assert len(inspect.getdoc(getattr(hookspecs, hook)).splitlines()) == 1
    assert f"`{hook}" in (DOCS / "reference" / "plugin_interface.md").read_text()


@pytest.mark.parametrize("cls", BUILT_IN, ids=lambda c: c.type)
def test_every_built_in_describes_itself_and_its_parameters(cls: type[Component]):
    assert inspect.getdoc(cls) not in (None, inspect.getdoc(Component))
    assert descriptions(cls).keys() == cls.model_fields.keys()


@pytest.mark.parametrize(
    "page", sorted(PAGES - COPIES), ids=lambda page: str(page.relative_to(ROOT))
)
def test_relative_links_of_a_page_lead_to_files(page):
    text = re.sub(r"^( *)```.*?^\1```|`.*?`", "", page.read_text("utf-8"), flags=re.S | re.M)
    links = [link for link in re.findall(r"\]\(([^)#]+)", text) if ":" not in link]
    assert not [link for link in links if not (page.parent / link).exists()]


def test_the_site_is_short():
    site = (page for page in PAGES - COPIES if "docs" in page.relative_to(ROOT).parts)
    written = {page for page in site if not {"_generated", "_build"} & {*page.parts}}
    counts = {page: words(page) for page in written if page.name != "plugin_api.md"}
    assert max(counts.values()) <= 2000
    assert 20_000 < sum(counts.values()) <= 30_000


def words(page):
    """Return the number of words of a page, with its tables but without code and addresses."""
    text = re.sub(r"\A---\n.*?^---\n", "", page.read_text("utf-8"), flags=re.S | re.M)
    text = re.sub(r"^( *)```.*?^\1```|\]\([^)]*\)", "", text, flags=re.S | re.M)
    return len(text.split())
