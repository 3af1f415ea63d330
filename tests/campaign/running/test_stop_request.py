"""The first interrupt asks, the second one stops."""

from campaign.running.stop_request import ECHO, StopRequest


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
