"""Gravity loading of a fine mesh takes long; whoever is asked to stop meanwhile leaves it within a second."""

import signal
import sys
import time
from contextlib import contextmanager

import pytest
from numba.core import types
from numba.core.dispatcher import Dispatcher

from campaign.running.stop_request import BrokenOff, listening
from campaign.scene import load_scene
from campaign.simulation.ground import prepare

BEGUN = 0.5
"""Seconds of its own time after which this process is asked."""


@pytest.fixture(scope="module", autouse=True)
def compiled():
    """The ground of coarse cells, for which all that is used here is compiled."""
    return prepare(load_scene("ma2023", ["numerics.cell=2 m"]))


@contextmanager
def asked_to_stop():
    """By a signal that counts the processor's time, so that nothing depends on what else runs."""
    usual = signal.getsignal(signal.SIGPROF)
    try:
        with listening() as stop, stop.breaking_off():
            signal.signal(signal.SIGPROF, stop.receive)
            signal.setitimer(signal.ITIMER_PROF, BEGUN)
            yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, usual)


@pytest.mark.parametrize("gravity", ["release", "ramp"])
def test_it_is_left_within_a_second_and_nothing_is_kept_of_it(tmp_path, gravity):
    scene = load_scene("ma2023", ["numerics.cell=0.2 m", f"numerics.gravity={gravity}"])
    begin = time.process_time()
    with pytest.raises(BrokenOff), asked_to_stop():
        prepare(scene, tmp_path)
    assert BEGUN <= time.process_time() - begin < BEGUN + 1.0
    assert not list(tmp_path.iterdir())


def test_kernels_return_numbers_alone(compiled):
    """Where one makes anything else for Python, and a signal raises in the code for that, the process crashes."""
    compiled.simulate(0, interrupt=lambda: False)
    ours = [module for name, module in sys.modules.items() if name.startswith(("solver.", "campaign."))]
    kernels = {each for module in ours for each in vars(module).values() if isinstance(each, Dispatcher)}
    returned = {kernel: {each.return_type for each in kernel.nopython_signatures} for kernel in kernels}
    assert sum(map(bool, returned.values())) >= 4
    plain = (types.NoneType, types.Number, types.Boolean)
    assert not [kernel for kernel, found in returned.items() if not all(isinstance(each, plain) for each in found)]
