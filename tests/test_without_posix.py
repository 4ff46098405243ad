"""Nothing needs the modules that Windows lacks, nor psutil."""

import pytest
from without_posix import run_in


@pytest.mark.slow
def test_a_case_a_resume_and_a_sweep_run_without_fcntl_resource_and_psutil(tmp_path):
    ended = run_in(tmp_path)
    assert (ended.stdout, ended.returncode) == ("run, resumed, swept\n", 0), ended.stderr
