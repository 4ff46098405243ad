"""Text from a file does not reach the terminal with its control characters."""

import io
import json

import pytest
from command_line import tribo
from edited import edited
from made_results import written
from rich.console import Console as RichConsole

from tribo.cli.console import Console
from tribo.cli.streams import harmless
from tribo.templates import template

EVIL = "\x1b]0;pwned\x07\x1b[2J\x9b31m\r\x08[/x]"
PLUGIN = dict.fromkeys(("distribution", "version", "status", "reason"), EVIL)
MADE_WITH = {"python": EVIL, "packages": {EVIL: EVIL}, "components": {}, "plugins": [PLUGIN]}


def command(*arguments):
    done = tribo(*arguments)
    text = done.stdout + done.stderr
    assert not set(text) & set("\x1b\x07\x9b\r\x08")
    return done.returncode, text


@pytest.mark.parametrize(
    ("changes", "shown"),
    [
        ({"findings": [{"kind": EVIL, "words": ""}]}, r"Note: \x1b]0;pwned"),
        ({"provenance": MADE_WITH}, r"made with: Python \x1b]0;pwned"),
    ],
    ids=["findings", "provenance"],
)
def test_a_result_is_shown_without_them(tmp_path, changes, shown):
    result = written(tmp_path / "x.h5")
    with edited(result) as file:
        for key, value in changes.items():
            file.attrs[key] = json.dumps(value)
    code, text = command("show", result)
    assert code == 0
    assert shown in text


def test_a_message_on_a_case_is_printed_without_them(tmp_path):
    case = tmp_path / "case.toml"
    case.write_text(template("ball_on_disk") + '\n["\\u001b[2J"]\n')
    code, text = command("check", case)
    assert code == 2
    assert r'"\x1b[2J": unknown key' in text


def test_what_turns_the_direction_of_writing_is_shown_as_an_escape():
    assert harmless("a\u202eb\tµ³\n") == "a\\u202eb\tµ³\n"


def test_styles_of_its_own_stay():
    printed = []
    for kind in (RichConsole, Console):
        console = kind(file=io.StringIO(), force_terminal=True, color_system="standard")
        console.print("[red]Note:[/] µ")
        printed.append(console.file.getvalue())
    assert printed[0] == printed[1]
