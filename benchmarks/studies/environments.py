"""Install the kernel alone, with each package and with all, and try every command there.

    python -m benchmarks.studies.environments [PACKAGE ...]

Each environment is new and empty. Every command shows its help, a small case is made, checked,
run, shown, drawn, exported and compared, and a package's own tests pass.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGES = sorted(path.name for path in (ROOT / "plugins").iterdir() if path.is_dir())
SMALL = (
    "--set",
    "grid.cells=32",
    "--set",
    "kinematics.duration=20",
    "--set",
    "output.save_times=[]",
)
USE = (
    ("new", "ball_on_disk", "my.toml"),
    ("check", "my.toml", *SMALL),
    ("run", "my.toml", "-o", "my.h5", *SMALL),
    ("show", "my.h5"),
    ("plot", "my.h5", "-d", "pictures"),
    ("export", "my.h5", "-d", "csv"),
    ("run", "my.toml", "-o", "other.h5", *SMALL, "--set", "load.normal=80"),
    ("compare", "my.h5", "other.h5", "-o", "compared"),
    ("plugins", "list"),
    ("doctor",),
    ("verify", "archard_k"),
)


def tried(packages: list[str], folder: Path) -> str:
    """Return what failed in an environment with some packages; nothing if all holds."""
    subprocess.run([sys.executable, "-m", "venv", folder / "env"], check=True)
    programs = folder / "env" / ("Scripts" if os.name == "nt" else "bin")
    sources = [str(ROOT), *(str(ROOT / "plugins" / name) for name in packages)]

    def run(*command: str | Path) -> str:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        return "" if done.returncode == 0 else f"{command}: {(done.stdout + done.stderr)[-500:]}"

    failed = [run(programs / "pip", "install", "--quiet", *sources)]
    shown = subprocess.run([programs / "tribo", "--help"], capture_output=True, text=True).stdout
    commands = shown.partition("Commands:")[2].partition("Not installed:")[0]
    # A command's line is indented by two; those that go on, by more.
    names = [line.split()[0] for line in commands.splitlines() if line[2:3].strip()]
    failed += [run(programs / "tribo", name, "--help") for name in names]
    failed += [run(programs / "tribo", *words) for words in USE]
    if len(packages) == 1:
        run(programs / "pip", "install", "--quiet", "pytest", "hypothesis")
        tests = ROOT / "plugins" / packages[0] / "tests"
        failed.append(run(programs / "python", "-m", "pytest", "-q", "-m", "not slow", tests))
    return "\n".join(filter(None, failed))


def main() -> None:
    """Try each environment in turn."""
    chosen = sys.argv[1:] or PACKAGES
    for packages in ([], *([name] for name in chosen), PACKAGES):
        with tempfile.TemporaryDirectory() as folder:
            failed = tried(packages, Path(folder))
        print(f"{', '.join(packages) or 'kernel alone':30.60} {failed or 'all holds'}", flush=True)


if __name__ == "__main__":
    main()
