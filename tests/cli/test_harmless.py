"""Text from a file does not reach the terminal with its control characters."""

import json

import pytest
from command_line import tribo
from edited import edited
from made_results import written
from rich.console import Console as RichConsole

from tribo.cli.console import Console
from tribo.cli.streams import harmless
from tribo.result.provenance import provenance
from tribo.templates import template

EVIL = "\x1b]0;pwned\x07\x1b[2J\x9b31m\r\x08[/x]"


def command(*arguments):
    done = tribo(*arguments)
    text = done.stdout + done.stderr
    assert not set(text) & set("\x1b\x07\x9b\r\x08")
    return done.returncode, text


@pytest.fixture
def result(tmp_path):
    return written(tmp_path / "x.h5")


def test_notices_are_shown_without_them(result):
    with edited(result) as file:
        file.attrs["notices"] = json.dumps([EVIL])
    code, text = command("show", result)
    assert code == 0
    assert r"Note: \x1b]0;pwned" in text


def test_provenance_is_shown_without_them(result):
    made_with = provenance({}) | {"python": EVIL, "packages": {EVIL: EVIL}}
    plugin = dict.fromkeys(("distribution", "version", "status", "reason"), EVIL)
    with edited(result) as file:
        file.attrs["provenance"] = json.dumps(made_with | {"plugins": [plugin]})
    assert command("show", result)[0] == 0


def test_names_of_bodies_are_shown_without_them(result):
    evil = EVIL.replace("/", "\\")
    with edited(result) as file:
        file.attrs["case"] = json.dumps({"bodies": {evil: {}, "[disk]": {}}})
        file["body"][:] = [evil, "[disk]"]
    code, text = command("show", result)
    assert code == 0
    assert "[disk]" in text


def test_a_message_on_a_case_is_printed_without_them(tmp_path):
    case = tmp_path / "case.toml"
    case.write_text(template("ball_on_disk") + '\n["\\u001b[2J"]\n')
    code, text = command("check", case)
    assert code == 2
    assert r"unknown key '\x1b[2J'" in text


def test_what_turns_the_direction_of_writing_is_shown_as_an_escape():
    assert harmless("a\u202eb\tµ³\n") == "a\\u202eb\tµ³\n"


def test_styles_of_its_own_stay(tmp_path):
    for kind in (RichConsole, Console):
        with (tmp_path / kind.__module__).open("w+", encoding="utf-8") as file:
            kind(file=file, force_terminal=True, color_system="standard").print("[red]Note:[/] µ")
    assert len({path.read_text() for path in tmp_path.iterdir()}) == 1
