"""Before the first realization one rank of each node compiles, and the others find its code."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from time import sleep
from types import SimpleNamespace

from campaign.running.mpi import _rehearse

NODES = ("left", "left", "left", "right", "right")
"""The node of each rank."""


def communicator(rank, size, arrived, node=None):
    """In the place of MPI's: ranks are threads, and each meets the others once."""
    barrier = SimpleNamespace(Test=lambda: len(arrived) == size)

    def meet():
        arrived.append(rank)
        return barrier

    return SimpleNamespace(rank=rank, Split_type=lambda _kind: node, Ibarrier=meet, Free=lambda: None)


@dataclass
class Compiler:
    """In the place of a worker: notes in what order ranks compile and have compiled."""

    node: str
    log: list[tuple[str, str]]

    def rehearse(self):
        self.log.append((self.node, "begins"))
        sleep(0.02)
        self.log.append((self.node, "ends"))


def communicators():
    """Return those of all ranks, each of which knows that of its node."""
    everybody, on_node = [], {node: [] for node in NODES}
    for rank, node in enumerate(NODES):
        of_node = communicator(rank - NODES.index(node), NODES.count(node), on_node[node])
        yield communicator(rank, len(NODES), everybody, of_node)


def test_one_rank_of_each_node_compiles_while_the_others_wait():
    log, after = [], []

    def rank(comm):
        _rehearse(comm, Compiler(NODES[comm.rank], log))
        after.append(len(log))

    with ThreadPoolExecutor(len(NODES)) as ranks:
        list(ranks.map(rank, communicators()))
    for node in set(NODES):
        here = [what for where, what in log if where == node]
        assert here[:2] == ["begins", "ends"]
        assert len(here) == 2 * NODES.count(node)
    assert {where for where, _ in log[:2]} == set(NODES), "no node waits for another one"
    assert after == [2 * len(NODES)] * len(NODES), "nobody begins before all can"
