"""Which MPI library mpi4py has loaded, without starting it."""


def mpi_library() -> str:
    """Return the first line of the MPI library's own description, or why there is none."""
    import mpi4py

    mpi4py.rc.initialize = False
    try:
        from mpi4py import MPI
    except (ImportError, RuntimeError) as error:
        return f"none ({error})"
    return str(MPI.Get_library_version().splitlines()[0].rstrip("\x00"))
