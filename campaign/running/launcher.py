"""Whether the launcher and the MPI library found each other.

When they are of different makes, N copies of the whole campaign start, each believing to be alone, and nothing says so.
"""

from collections.abc import Mapping

SIZES = ("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS")
"""Launchers' own counts, the most specific first; under hydra SLURM's counts nodes. SLURM_NTASKS is the job's."""


def mismatch(size: int, environment: Mapping[str, str]) -> str:
    """Return the sentence that explains why `size` ranks is not what the launcher started, or "" if all is well."""
    launched = next(((name, environment[name]) for name in SIZES if name in environment), None)
    if size > 1 or launched is None or launched[1] in ("0", "1"):
        return ""
    name, count = launched
    return (
        f"The launcher started {count} processes ({name}), but this one finds itself alone: mpirun or srun does not "
        "belong to the MPI library that mpi4py loaded, and each process would run the whole campaign. Start it with "
        "the mpirun of the same environment; with srun name the plugin (MPICH: --mpi=pmi2, Open MPI: --mpi=pmix)."
    )
