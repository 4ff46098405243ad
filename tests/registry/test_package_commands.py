"""Packages add commands to `tribo`, and hurt no other command where they fail."""

import pytest
from command_line import tribo
from fake_distributions import distribute

from tribo.cli.commands import OWN, offered

HOOKS = """
from tribo import Command, hookimpl

@hookimpl
def tribo_commands():
    return [Command({name!r}, "Say it.", "{place}")]
"""
SAY = """
import click

@click.command()
def say():
    click.echo("said")
"""


@pytest.fixture
def install(folder):
    """A function that installs the package acme-words, with a command."""

    def add(name="say", place="acme_say:say", hooks=HOOKS):
        modules = {"acme_words": hooks.format(name=name, place=place), "acme_say": SAY}
        distribute(folder, "acme-words", "1.0", {"acme-words": "acme_words"}, **modules)

    return add


def test_a_command_of_a_package_is_listed_and_runs(install):
    install()
    assert "Say it." in tribo("--help").stdout
    done = tribo("say")
    assert (done.returncode, done.stdout) == (0, "said\n")


@pytest.mark.parametrize("code", ["1 / 0", "raise SystemExit(0)"])
def test_a_package_that_fails_is_named_by_help_and_costs_no_other_command_a_word(install, code):
    install(hooks=code)
    done = tribo("--help")
    assert done.returncode == 0
    assert "acme-words 1.0" in done.stderr
    assert all(name in done.stdout for name in OWN)
    assert tribo("run", "--help").stderr == ""


def test_a_command_that_cannot_be_imported_is_a_fault_of_its_package(install):
    install(place="acme_say:nothing")
    done = tribo("say")
    assert done.returncode == 3
    assert "acme_say:nothing" in done.stderr


def test_no_package_replaces_a_command_of_the_kernel(install):
    install(name="run")
    assert "acme_say:say is left out" in tribo("--help").stderr
    assert offered()["run"].place == "tribo.cli.run:run"
