"""No process that tribo starts imports from the folder that it was started in."""

import os
import subprocess
import sys

import pytest
import sweeps

PACKAGES = {"click", "h5py", "matplotlib", "numpy", "pandas", "pluggy", "pydantic", "rich", "scipy"}
COMMANDS = {
    "sweep": ["sweep", "my.toml", "--vary", "grid.cells=[10]", "--jobs", "1"],
    "kit": ["plugins", "check", "energy.friction_traction"],
}


def needed_to_start(folder):
    """Modules that Python itself imports before a package that is started with -m."""
    (folder / "package").mkdir()
    (folder / "package" / "__main__.py").write_text("import sys; print(*sys.modules)")
    command = [sys.executable, "-m", "package"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True).stdout.split()


@pytest.mark.slow
@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_imports_nothing_from_the_folder_it_starts_in(tmp_path, name):
    folder = sweeps.case(tmp_path / "hostile").parent
    for module in (sys.stdlib_module_names | PACKAGES) - {*needed_to_start(tmp_path)}:
        code = f"print('a stranger', file=open({str(tmp_path / 'seen')!r}, 'a')); raise ImportError"
        (folder / f"{module}.py").write_text(code)
    done = subprocess.run(
        [sys.executable, "-m", "tribo", *COMMANDS[name]],
        cwd=folder,
        env={**os.environ, "TRIBO_PLUGINS": "tribo-energy"},
        capture_output=True,
        text=True,
        timeout=500,
        check=False,
    )
    assert not (tmp_path / "seen").exists()
    assert done.returncode == 0, done.stderr
    # Runs warn in their tables.
    assert "Warning" not in done.stderr
