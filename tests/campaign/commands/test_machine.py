"""The memory that a process may use is that of its control group, if there is a smaller limit than the machine's."""

import pytest

from campaign.commands.machine import control_group_limits, memory


def test_the_machine_has_memory():
    assert memory() > 1e8


@pytest.mark.parametrize(
    ("membership", "file", "limit"),
    [
        ("0::/slurm/job_7/step_0\n", "slurm/job_7/memory.max", 4e9),
        ("0::/\n", "memory.max", 4e9),
        ("4:memory:/jobs/7\n0::/\n", "memory/jobs/7/memory.limit_in_bytes", 4e9),
        ("4:memory:/outside/7\n", "memory/memory.limit_in_bytes", 4e9),
    ],
)
def test_limits_of_groups_around_a_process_count(tmp_path, membership, file, limit):
    (tmp_path / "cgroup").write_text(membership)
    path = tmp_path / "root" / file
    path.parent.mkdir(parents=True)
    path.write_text("4000000000\n")
    assert control_group_limits(tmp_path / "cgroup", tmp_path / "root") == [limit]


def test_no_limit_is_no_limit(tmp_path):
    (tmp_path / "cgroup").write_text("0::/\n")
    (tmp_path / "memory.max").write_text("max\n")
    assert control_group_limits(tmp_path / "cgroup", tmp_path) == []
    assert control_group_limits(tmp_path / "absent", tmp_path) == []
