"""The first interrupt asks, the second one stops."""

import signal
import time

import pytest

from campaign.running.stop_request import AGAIN, ECHO, BrokenOff, StopRequest, listening


def test_the_second_interrupt_stops_now_but_an_echo_of_the_first_does_not(monkeypatch):
    clock = [100.0]
    monkeypatch.setattr("campaign.running.stop_request.time.monotonic", lambda: clock[0])
    stop = StopRequest()
    stop.receive(2)
    stop.receive(2)
    assert (stop.drain, stop.now) == (True, False)
    clock[0] += 2 * ECHO
    stop.receive(2)
    assert stop.now


@pytest.mark.parametrize(("number", "now"), [(signal.SIGTERM, True), (signal.SIGUSR1, False), (signal.SIGINT, False)])
def test_term_leaves_no_time_to_finish(number, now):
    stop = StopRequest()
    stop.receive(number)
    assert (stop.drain, stop.now) == (True, now)


def test_what_can_be_done_again_is_left_at_once():
    with listening() as stop:
        with pytest.raises(BrokenOff), stop.breaking_off():
            signal.raise_signal(signal.SIGUSR1)
        signal.raise_signal(signal.SIGUSR1)  # outside, only a flag
        assert stop.drain


class Interrupted:
    """A signal comes while it is destroyed, when Python drops exceptions."""

    def __del__(self):
        signal.raise_signal(signal.SIGUSR1)


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_what_drops_an_exception_is_left_a_moment_later():
    def destroy_and_wait():
        del [Interrupted()][0]
        assert stop.drain
        time.sleep(20 * AGAIN)

    with listening() as stop, pytest.raises(BrokenOff), stop.breaking_off():
        destroy_and_wait()
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


def test_what_has_been_left_is_not_broken_off_again():
    with listening() as stop:
        with pytest.raises(BrokenOff), stop.breaking_off():
            signal.raise_signal(signal.SIGUSR1)
        signal.raise_signal(signal.SIGALRM)  # that had been under way
