"""From nothing to a result: new, wheel, fresh environment, its own tests, a case."""

import os
import subprocess
import sys
import sysconfig
import venv
from dataclasses import dataclass
from pathlib import Path

import pytest
from scaffold.plugins_of_each_kind import NAMES

from tribo.result.read import Result
from tribo.scaffold import plugin_names, write_plugin

pytestmark = pytest.mark.slow
ROOT = Path(__file__).parents[2]
COMPONENTS = {name: plugin_names(name)["component"] for name in NAMES.values()}

# Whatever else is installed where the tests run takes no part.
ONLY = {**os.environ, "TRIBO_PLUGINS": ",".join(NAMES.values())}


def run(*command, folder, code=0):
    sources = os.pathsep.join(map(str, folder.glob("*/src")))
    done = subprocess.run(
        command,
        cwd=folder,
        env={**ONLY, "MYPYPATH": sources},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == code, done.stdout + done.stderr
    return done.stderr if code else done.stdout


@dataclass(frozen=True)
class Fresh:
    """An environment with the wheels of six new plugins, and their folders."""

    python: Path
    folders: dict[str, Path]
    scratch: Path


@pytest.fixture(scope="module")
def fresh(tmp_path_factory):
    scratch = tmp_path_factory.mktemp("plugins")
    folders = {kind: scratch / name for kind, name in NAMES.items()}
    for kind, folder in folders.items():
        write_plugin(folder.name, kind, folder)
    pip = (sys.executable, "-m", "pip", "--disable-pip-version-check")
    venv.create(scratch / "venv", with_pip=False)
    python = scratch / "venv" / "bin" / "python"
    # It sees what is installed here, tribo too, so that nothing is downloaded.
    purelib = run(
        python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))", folder=scratch
    )
    here = sysconfig.get_path("purelib")
    (Path(purelib.strip()) / "here.pth").write_text(f"import site; site.addsitedir({here!r})\n")
    install = ("install", "--no-deps", "--no-build-isolation", "--no-index")
    built = [f"./{folder.name}" for folder in folders.values()]
    run(*pip, "--python", str(python), *install, *built, folder=scratch)
    return Fresh(python, folders, scratch)


def test_their_own_tests_pass_untouched(fresh):
    quiet = ("-q", "-p", "no:cacheprovider", "--import-mode=importlib", "-W", "error")
    tests = [folder / "tests" for folder in fresh.folders.values()]
    said = run(fresh.python, "-m", "pytest", *quiet, *tests, folder=fresh.scratch)
    assert " passed" in said
    # Where it is not installed, as here, it says what to do.
    untold = run(sys.executable, "-m", "pytest", *quiet, tests[0], folder=fresh.scratch, code=4)
    assert "install it first" in untold


def test_their_types_are_right(fresh):
    code = [*fresh.scratch.glob("*/src"), *fresh.scratch.glob("*/tests/test_*.py")]
    # What mypy has found of tribo itself, if it was run here, it need not find again.
    kept = ("--cache-dir", ROOT / ".mypy_cache")
    types = ("--strict", "--explicit-package-bases", *kept)
    run(sys.executable, "-m", "mypy", *types, *code, folder=fresh.scratch)


CASE = """
[grid]
size = "0.6 mm"
cells = 40

[load]
normal = "20 N"

[bodies.ball]
surface = { type = "acme.dome", radius = "5 mm" }
material = { young = "207 GPa", poisson = 0.3 }
wear = { type = "acme.fretting", k = "1e-15 1/Pa" }

[bodies.disk]
surface = { type = "flat" }
material = { young = "207 GPa", poisson = 0.3 }

[contact]
type = "acme.layered"

[kinematics]
type = "acme.shuttle"
speed = "0.1 m/s"
track = "20 mm"
duration = "60 s"

[[effects]]
type = "acme.heat"
friction = 0.2

[[observers]]
type = "acme.depth_watch"
depth = "1 um"
"""


def test_one_case_runs_with_all_of_them(fresh):
    (fresh.scratch / "all.toml").write_text(CASE)
    run(fresh.python, "-m", "tribo", "run", "all.toml", "-o", "all.h5", folder=fresh.scratch)
    with Result.open(fresh.scratch / "all.h5") as result:
        volume = result.saves()[-1]["bodies"]["ball"]["wear_volume_m3"]
        components = result.provenance["components"].values()
    assert volume == pytest.approx(1e-15 * 20 * 6, rel=1e-6, abs=0)
    used = {c["type"]: (c["distribution"], c["version"]) for c in components}
    for name, component in COMPONENTS.items():
        assert used[component] == (name, "0.1.0")
