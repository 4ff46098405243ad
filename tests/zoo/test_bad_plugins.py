"""A zoo of plugins that cannot be loaded: harmless until named, and then one clear message."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from fake_distributions import distribute

import tribo
from tribo import Result

# Each is a command in a process of its own.
pytestmark = pytest.mark.slow

LAW = """
import numpy as np
from tribo import Field, LocalConditions, WearLaw, WearRate, hookimpl

class Bad(WearLaw):
    type = "zoo.bad"
    {extra}

    def rate(self, local: LocalConditions) -> WearRate:
        p = local.pressure
        k = np.full_like(p, 3e-16)
        {body}

@hookimpl
def tribo_components():
    return [Bad]
"""
GOOD = "return WearRate(k * p, k)"


def law(body, extra=""):
    return LAW.format(body=body, extra=extra)


# What is wrong: the module's code, and what the message says besides the name.
ZOO = {
    "import error": ("import no_such_module_at_all", "zoo_bad.py, line 1)"),
    "missing dependency": ("from numpy import no_such_name", "no_such_name"),
    "exit": ("raise SystemExit(0)", "SystemExit"),
    "hook typo": (law(GOOD).replace("tribo_comp", "tribo_com"), "unknown hook 'tribo_com"),
    "wrong base class": (law(GOOD).replace("[Bad]", "[dict]"), "must be a subclass of"),
    "abstract": (law(GOOD).replace("def rate", "def rates"), "does not define rate"),
    "state fields that are names": (law(GOOD, "state_fields = ('slid',)"), "tuple of Field"),
    "a state field with a slash": (
        law(GOOD, "state_fields = (Field('a/b', 'm', 'Slid.'),)"),
        "Bad.state_fields: 'a/b' cannot name a field; letters, digits and underscores are allowed",
    ),
    "requires a text": (law(GOOD, "requires = 'temperature'"), "tuple of names"),
    "hook that returns a class": (law(GOOD).replace("[Bad]", "Bad"), "must return a list"),
}
# What only a process of its own survives.
DEADLY = {
    "endless import": ("while True: pass", "did not end"),
    "native crash": ("import ctypes; ctypes.string_at(0)", "crashed the process (SIGSEGV)"),
}
CASE = """
[grid]
size = "0.7 mm"
cells = 32
[load]
normal = 100
[bodies.ball]
surface = {{ type = "sphere", radius = "5 mm" }}
wear = {wear}
[bodies.ball.material]
young = "207 GPa"
poisson = 0.3
[bodies.disk]
surface = "flat"
[bodies.disk.material]
young = "207 GPa"
poisson = 0.3
[kinematics]
type = "reciprocating"
stroke = "2 mm"
frequency = 25
distance = "2 m"
"""


def command(folder, *args):
    path = os.pathsep.join([str(folder / "site"), str(Path(tribo.__file__).parents[1])])
    return subprocess.run(
        [sys.executable, "-m", "tribo", *args],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": path, "TRIBO_PLUGIN_TIME_LIMIT": "3"},
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )


def keep(folder, module_code, distribution="zoo-tribo", requires=()):
    points = {"zoo.bad": "zoo_bad"}
    distribute(folder / "site", distribution, "1.0", points, requires, zoo_bad=module_code)
    (folder / "plain.toml").write_text(CASE.format(wear='{ type = "archard", k = 3e-16 }'))
    (folder / "named.toml").write_text(CASE.format(wear='"zoo.bad"'))


@pytest.mark.parametrize("fault", [*ZOO, *DEADLY])
def test_it_is_harmless_where_it_is_not_named(tmp_path, fault):
    keep(tmp_path, {**ZOO, **DEADLY}[fault][0])
    plain = command(tmp_path, "check", "plain.toml")
    assert (plain.returncode, plain.stderr) == (0, "")


@pytest.mark.parametrize("fault", ZOO)
def test_where_it_is_named_one_line_says_what_is_wrong(tmp_path, fault):
    code, words = ZOO[fault]
    keep(tmp_path, code)
    named = command(tmp_path, "run", "named.toml")
    assert named.returncode == 2, named.stderr
    (line,) = named.stderr.strip().splitlines()
    assert line.startswith("error: bodies.ball.wear: wear law 'zoo.bad' cannot be used: ")
    assert words in line
    assert not (tmp_path / "named.h5").exists()


@pytest.mark.parametrize("fault", DEADLY)
def test_the_doctor_and_the_check_try_it_in_a_process_of_its_own(tmp_path, fault):
    code, words = DEADLY[fault]
    keep(tmp_path, code)
    seen = command(tmp_path, "doctor")
    assert seen.returncode == 3
    assert words in seen.stdout
    assert "zoo-tribo 1.0" in seen.stderr
    checked = command(tmp_path, "plugins", "check", "zoo.bad")
    assert checked.returncode == 2
    assert "'zoo.bad' is in zoo-tribo 1.0, which is broken: " in checked.stderr
    assert words in checked.stderr


def test_listing_imports_no_plugin(tmp_path):
    keep(tmp_path, "while True: pass")
    listed = command(tmp_path, "plugins", "list")
    assert listed.returncode == 0
    assert "zoo.bad" in listed.stdout
    assert "available" in listed.stdout


def test_a_requirement_that_does_not_hold_is_told_by_the_doctor_and_where_it_is_named(tmp_path):
    keep(tmp_path, law(GOOD), requires=["tribo<0.0.1"])
    told = "zoo-tribo 1.0 is incompatible: it requires tribo<0.0.1, but tribo is installed in"
    named = command(tmp_path, "run", "named.toml")
    assert named.returncode == 2
    assert told in named.stderr
    seen = command(tmp_path, "doctor")
    assert seen.returncode == 3
    assert "incompatible: it requires tribo<0.0.1" in seen.stdout


MEDDLING = """
import os, warnings
import numpy as np
os.chdir({elsewhere!r})
warnings.filterwarnings({filters!r})
np.seterr(all="raise")
"""


def meddler(tmp_path, filters):
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    keep(tmp_path, MEDDLING.format(elsewhere=str(elsewhere), filters=filters) + law(GOOD))
    return elsewhere


def test_an_import_moves_no_result(tmp_path):
    elsewhere = meddler(tmp_path, "ignore")
    done = command(tmp_path, "run", "named.toml", "-o", "out.h5")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out.h5").exists()
    assert list(elsewhere.iterdir()) == []


def test_a_plugin_that_makes_warnings_errors_does_not_end_an_unrelated_command(tmp_path):
    meddler(tmp_path, "error")
    # A second plugin that is left out of the schema with a warning.
    distribute(tmp_path / "site", "zzz-broken", "1.0", {"zzz.law": "zoo_broken"}, zoo_broken="1/0")
    done = command(tmp_path, "schema")
    assert done.returncode == 0, done.stderr
    assert "zzz-broken 1.0 is left out" in done.stderr


def test_the_schema_leaves_out_what_cannot_be_imported(tmp_path):
    keep(tmp_path, "raise RuntimeError('no')")
    done = command(tmp_path, "schema")
    assert done.returncode == 0
    assert "zoo.bad" not in done.stdout
    assert "zoo-tribo 1.0 is left out: RuntimeError: no" in done.stderr


def test_a_name_claimed_twice_is_unusable_and_says_by_whom(tmp_path):
    keep(tmp_path, law(GOOD))
    keep(tmp_path, law(GOOD), distribution="other-tribo")
    assert command(tmp_path, "run", "plain.toml").returncode == 0
    named = command(tmp_path, "run", "named.toml")
    assert named.returncode == 2
    assert "other-tribo 1.0 and zoo-tribo 1.0" in named.stderr.splitlines()[-1]
    alone = command(tmp_path, "--no-plugin", "other-tribo", "run", "named.toml")
    assert alone.returncode == 0, alone.stderr


@pytest.mark.parametrize(
    "choice", [["--no-plugin", "zoo"], ["--no-plugin", "zoo-tribo"], ["--plugins", "none"]]
)
def test_a_plugin_turned_off_cannot_be_used(tmp_path, choice):
    keep(tmp_path, law(GOOD))
    assert command(tmp_path, "run", "named.toml").returncode == 0
    off = command(tmp_path, *choice, "run", "named.toml", "--force")
    assert off.returncode == 2
    assert off.stderr.splitlines()[-1].startswith(
        "error: bodies.ball.wear: wear law 'zoo.bad' cannot be used: zoo-tribo 1.0 is disabled: "
    )
    assert "did you mean" not in off.stderr
    assert "Installed" not in off.stderr


def test_a_case_may_require_versions(tmp_path):
    keep(tmp_path, law(GOOD))
    case = tmp_path / "named.toml"
    text = case.read_text()
    case.write_text('requires = ["zoo-tribo>=1.0"]\n' + text)
    assert command(tmp_path, "run", "named.toml").returncode == 0
    for wanted, words in (("zoo-tribo>=2", "version 1.0"), ("zoo-more", "not installed")):
        case.write_text(f'requires = ["{wanted}"]\n{text}')
        done = command(tmp_path, "run", "named.toml", "--force")
        assert done.returncode == 2
        assert "error: requires: " in done.stderr
        assert words in done.stderr


def test_a_plugin_that_is_turned_off_meets_no_requirement(tmp_path):
    keep(tmp_path, law(GOOD))
    case = tmp_path / "plain.toml"
    case.write_text(f"requires = ['zoo-tribo>=1.0']\n{case.read_text()}")
    assert command(tmp_path, "check", "plain.toml").returncode == 0
    done = command(tmp_path, "--no-plugin", "zoo-tribo", "check", "plain.toml")
    assert done.returncode == 2
    assert "error: requires: " in done.stderr
    assert "the plugin zoo-tribo 1.0 is disabled: turned off by --no-plugin" in done.stderr


def test_a_requirement_counts_where_its_marker_holds(tmp_path):
    keep(tmp_path, law(GOOD))
    case = tmp_path / "plain.toml"
    text = case.read_text()
    for sign, code in (("<", 0), (">=", 2)):
        case.write_text(f"requires = ['zoo-more; python_version {sign} \"3\"']\n{text}")
        done = command(tmp_path, "check", "plain.toml")
        assert done.returncode == code, done.stderr


def test_a_law_that_fails_in_the_middle_leaves_the_last_good_state(tmp_path):
    keep(
        tmp_path,
        law(
            "self._n += 1\n        return WearRate(k * p * (np.nan if self._n > 80 else 1), k)",
            "_n: int = 0",
        ),
    )
    done = command(tmp_path, "run", "named.toml", "--set", "stepping.depth_tolerance=1e-5")
    assert done.returncode == 3
    assert "zoo.bad" in done.stderr
    with Result.open(tmp_path / "named.h5") as result:
        assert result.status == "failed"
        assert result.totals()["steps"] > 20
        last = result.saves()[-1]
        assert 0 < last["distance_m"] < 2
        volume = last["bodies"]["ball"]["wear_volume_m3"]
    assert volume == pytest.approx(3e-16 * 100 * last["distance_m"], rel=1e-10, abs=0)
    assert command(tmp_path, "show", "named.h5").returncode == 0


def test_the_result_says_who_took_part_and_a_changed_version_is_refused(tmp_path):
    stop = "import os, signal\n        os.kill(os.getpid(), signal.SIGINT)\n        "
    keep(tmp_path, law(stop + GOOD))
    assert command(tmp_path, "run", "named.toml").returncode == 130
    with Result.open(tmp_path / "named.h5") as result:
        made = result.provenance
    assert made["components"]["bodies.ball.wear"]["distribution"] == "zoo-tribo"
    assert made["components"]["bodies.ball.wear"]["version"] == "1.0"
    assert ("zoo-tribo", "loaded") in {(p["distribution"], p["status"]) for p in made["plugins"]}
    info = tmp_path / "site" / "zoo_tribo-1.0.dist-info" / "METADATA"
    info.write_text(info.read_text().replace("Version: 1.0", "Version: 1.1"))
    (tmp_path / "site" / "zoo_bad.py").write_text(law(GOOD))
    refused = command(tmp_path, "resume", "named.h5")
    assert refused.returncode == 2
    assert "zoo-tribo 1.0" in refused.stderr
    assert "zoo-tribo 1.1" in refused.stderr
    allowed = command(tmp_path, "resume", "named.h5", "--allow-changed")
    assert allowed.returncode == 0, allowed.stderr
    with Result.open(tmp_path / "named.h5") as result:
        assert result.status == "done"
        (later,) = result.provenance["resumed_with"]
    assert later["components"]["bodies.ball.wear"]["version"] == "1.1"


@pytest.mark.parametrize("fault", ["entry points", "no metadata", "odd value"])
def test_a_malformed_distribution_harms_no_other(tmp_path, fault):
    keep(tmp_path, law(GOOD))
    info = tmp_path / "site" / "odd-1.0.dist-info"
    info.mkdir()
    if fault != "no metadata":
        (info / "METADATA").write_text("Metadata-Version: 2.1\nName: odd\nVersion: 1.0\n")
    lines = {
        "entry points": "[console_scripts]\nno equals sign\n",
        "no metadata": "[tribo]\nodd.law = odd\n",
        "odd value": "[console_scripts]\nodd = not a module !!\n",
    }
    (info / "entry_points.txt").write_text(lines[fault])
    for args in (["plugins", "list"], ["run", "plain.toml"], ["run", "named.toml"]):
        done = command(tmp_path, *args)
        assert done.returncode == 0, done.stderr
    with Result.open(tmp_path / "named.h5") as result:
        origin = result.provenance["components"]["bodies.ball.wear"]
    assert (origin["distribution"], origin["version"]) == ("zoo-tribo", "1.0")


def test_a_plugin_is_not_tried_with_the_modules_of_the_folder_one_is_in(tmp_path):
    keep(tmp_path, law(GOOD))
    (tmp_path / "pluggy.py").write_text("raise SystemExit('a stranger in the folder')")
    path = os.pathsep.join([str(tmp_path / "site"), str(Path(tribo.__file__).parents[1])])
    done = subprocess.run(
        [sys.executable, "-P", "-m", "tribo", "plugins", "check", "zoo.bad"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )
    assert "a stranger in the folder" not in done.stderr
    assert "broken" not in done.stderr


def test_another_version_may_have_another_key(tmp_path):
    stop = "import os, signal\n        os.kill(os.getpid(), signal.SIGINT)\n        "
    keep(tmp_path, law(stop + GOOD))
    assert command(tmp_path, "run", "named.toml").returncode == 130
    info = tmp_path / "site" / "zoo_tribo-1.0.dist-info" / "METADATA"
    info.write_text(info.read_text().replace("Version: 1.0", "Version: 1.1"))
    newer = law(GOOD).replace('"zoo.bad"\n', '"zoo.bad"\n    extra: float = 1.0\n', 1)
    assert "extra" in newer
    (tmp_path / "site" / "zoo_bad.py").write_text(newer)
    refused = command(tmp_path, "resume", "named.h5")
    assert refused.returncode == 2
    assert "zoo-tribo 1.1" in refused.stderr
    assert command(tmp_path, "resume", "named.h5", "--allow-changed").returncode == 0
