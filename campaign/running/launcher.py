"""Whether the launcher and the MPI library found each other.

When they are of different makes, N copies of the whole campaign start, each believing to be alone, and nothing says so.
"""

from collections.abc import Mapping

from campaign.errors import RefusalError

SIZES = ("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS")
"""Launchers' own counts, the most specific first; under hydra SLURM's counts nodes. SLURM_NTASKS is the job's."""

RANKS = ("OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID")
"""The number of a process, of each of these launchers."""


def refuse_several(command: str, environment: Mapping[str, str]) -> None:
    """Make sure that a command that does not share its work among ranks was started once.

    Raises
    ------
    RefusalError
        In each of several processes; the first one says why.
    """
    launched = _launched(environment)
    if launched is None or launched[1] in ("0", "1"):
        return
    number = environment.get(RANKS[SIZES.index(launched[0])], "0")
    raise RefusalError(
        f'The launcher started {launched[1]} processes, and each would carry out "campaign {command}" alone, in the '
        "same place; start it without mpirun or srun. Only campaign run, tradeoff and screen share their work among "
        "ranks."
        if number == "0"
        else ""
    )


def mismatch(size: int, environment: Mapping[str, str]) -> str:
    """Return the sentence that explains why `size` ranks is not what the launcher started, or "" if all is well."""
    launched = _launched(environment)
    if size > 1 or launched is None or launched[1] in ("0", "1"):
        return ""
    name, count = launched
    return (
        f"The launcher started {count} processes ({name}), but this one finds itself alone: mpirun or srun does not "
        "belong to the MPI library that mpi4py loaded, and each process would run the whole campaign. Start it with "
        "the mpirun of the same environment; with srun name the plugin (MPICH: --mpi=pmi2, Open MPI: --mpi=pmix)."
    )


def _launched(environment: Mapping[str, str]) -> tuple[str, str] | None:
    """Return what a launcher calls the number of its processes, and that number; None without a launcher."""
    return next(((name, environment[name]) for name in SIZES if name in environment), None)
