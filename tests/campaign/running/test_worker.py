"""What goes wrong in a realization is a status, what goes wrong on its machine is not."""

import math
from dataclasses import replace

import pytest
from records import GROUND, make_record

from campaign.record import Status
from campaign.running.interrupt import Interrupt
from campaign.running.stop_request import StopRequest
from campaign.running.worker import Worker
from campaign.simulation.contract import Interrupted
from campaign.storage.attempts import Attempts
from campaign.storage.record_store import RecordStore


@pytest.fixture
def worker(tmp_path, monkeypatch):
    """Of a ground whose realizations end as `worker.ends` says: in a record, or in an exception."""

    def simulate(realization, interrupt):
        end = made.ends(realization)
        if isinstance(end, Exception):
            raise end
        return end

    ground = type("Ground", (), vars(GROUND) | {"simulate": staticmethod(simulate)})()
    store, attempts = RecordStore(tmp_path), Attempts(tmp_path)
    store.create()
    attempts.create()
    made = Worker(ground, store, attempts, 3, Interrupt(StopRequest(), math.inf, 60.0, lambda: None))
    made.ends = make_record
    return made


@pytest.mark.parametrize("error", [MemoryError(), OSError(28, "No space left"), ImportError("no file"), EOFError()])
def test_a_fault_of_the_machine_is_not_recorded(worker, error):
    worker.ends = lambda _realization: error
    report = worker.run(5)
    assert report.finished is None
    assert report.fault.realization == 5
    assert "rank 3 on " in report.fault.reason
    assert type(error).__name__ in report.fault.reason
    assert worker.store.finished() == set()


def test_a_compiler_that_fails_is_one(worker):
    from numba.core.errors import NumbaError

    worker.ends = lambda _realization: NumbaError("no code")
    assert worker.run(5).fault is not None


@pytest.mark.parametrize("error", [ZeroDivisionError("no mass"), ValueError("negative"), Interrupted()])
def test_what_the_scene_causes_is_a_status(worker, error):
    worker.ends = lambda _realization: error
    assert worker.run(5).finished.status in (Status.crashed, Status.timeout)
    assert worker.store.finished() == {5}


def test_two_faults_in_a_row_and_no_two_others_end_the_work_of_a_rank(worker, capsys):
    ends = iter([MemoryError(), make_record(1), MemoryError(), MemoryError()])
    worker.ends = lambda _realization: next(ends)
    reports = [worker.run(realization) for realization in range(4)]
    assert [report.fault.retires for report in reports if report.fault] == [False, False, True]
    assert capsys.readouterr().out.count("No more work for rank 3") == 1


def test_a_rank_that_fails_its_rehearsal_takes_no_work_at_all(worker):
    worker.ends = lambda _realization: OSError(28, "No space left")
    worker.rehearse()
    worker.ends = make_record
    assert worker.run(0).fault.retires
    assert worker.store.finished() == set()


def test_a_scene_that_fails_in_the_rehearsal_is_judged_in_its_turn(worker):
    worker.ends = lambda _realization: ZeroDivisionError()
    worker.rehearse()
    assert worker.run(0).finished.status is Status.crashed


def test_a_slide_without_a_runout_has_diverged(worker):
    record = make_record(2)
    worker.ends = lambda _realization: replace(record, values=record.values | {"final_runout_mass": math.nan})
    assert worker.run(2).finished.status is Status.diverged
    assert worker.store.read(2).reason == "its run-out is not a number"
