"""`tribo plugins`: list, describe, check and begin plugins."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import PATH, echo_json
from tribo.core.errors import CaseError, NumericalError
from tribo.registry.catalogue import catalogue, describe, matching
from tribo.registry.registry import default_registry


@click.group()
def plugins() -> None:
    """List, show, check and begin plugins.

    \b
    Example:
      tribo plugins list
      tribo plugins show archard
      tribo plugins new acme-fretting --kind wear-law
    """


@plugins.command("list")
@click.option("--json", "as_json", is_flag=True, help="Print a JSON list.")
def list_(as_json: bool) -> None:
    """List every component, and every plugin that cannot be used; imports no plugin.

    \b
    Example:
      tribo plugins list --json
    """
    rows = catalogue(default_registry())
    if as_json:
        echo_json(rows)
        return
    for row in rows:
        name, kind = row["name"] or "-", row["kind"] or "when imported"
        whose, words = f"{row['distribution']} {row['version']}", row["reason"] or row["summary"]
        click.echo(f"{name:24} {kind:16} {whose:24} {row['status']:10} {words}")


@plugins.command()
@click.argument("name")
def show(name: str) -> None:
    """Show the component NAME: equation, parameters, what it requires and provides.

    \b
    Example:
      tribo plugins show archard
    """
    registry = default_registry()
    for number, component in enumerate(matching(registry, name)):
        cls = registry.find(component)
        assert cls is not None
        described = describe(cls, registry.owners[component])
        click.echo(f"\n{described}" if number else described)


@plugins.command()
@click.argument("name")
def check(name: str) -> None:
    """Run the conformance checks on a component, or on all of a distribution or of a Python file.

    They are generated from the examples that its class gives,
    or from its defaults if it has any for every key. A component that cannot
    be made without a file is named and left to the tests of its package. Exit
    codes: 0 nothing failed, 2 bad input, 3 some failed.

    \b
    Example:
      tribo plugins check acme.fretting
      tribo plugins check acme-fretting
      tribo plugins check law.py
    """
    from tribo.registry.all_plugins import try_out
    from tribo.registry.plugin_file import add_files
    from tribo.testing import check as conform

    if name.endswith(".py"):
        add_files([name])
        name = Path(name).name
    registry, failed = default_registry(), []
    for component in matching(registry, name):
        owner = registry.owners[component]
        try_out([owner])
        if not owner.usable:
            raise CaseError(f"{component!r} is in {owner}, which is {owner.status}: {owner.reason}")
        cls = registry.find(component)
        assert cls is not None
        fields = cls.model_fields.items()
        files = [key for key, each in fields if each.is_required() and each.annotation is Path]
        try:
            if files and not cls.examples:
                click.echo(
                    f"{component}: not checked, for want of a file as its {' and '.join(files)}; "
                    f"the tests of {owner.distribution} have to"
                )
                continue
            report = conform(cls)
        except ValueError as error:
            raise NumericalError(f"the examples of {component!r}: {error}") from error
        click.echo(str(report))
        if not report.ok:
            failed.append(component)
    if failed:
        raise NumericalError(f"{', '.join(failed)} does not conform; see above")


@plugins.command()
@click.argument("name")
@click.option(
    "--kind",
    required=True,
    metavar="KIND",
    help="Write a component of this kind: wear-law, effect, surface, …",
)
@click.option("-d", "--directory", type=PATH, default=Path(), help="Write to this folder.")
def new(name: str, kind: str, directory: Path) -> None:
    """Write a complete plugin distribution NAME that installs and passes its tests.

    \b
    Kinds: contact-solver, wear-law, kinematics, surface, effect, observer.
    Example:
      tribo plugins new acme-fretting --kind wear-law
      pip install -e "acme-fretting[dev]" && pytest acme-fretting
    """
    from tribo.scaffold import write_plugin

    folder = directory / name
    for path in write_plugin(name, kind, folder):
        click.echo(f"Wrote {path}")
    click.echo(f'Now: pip install -e "{folder}[dev]" && pytest {folder}')
