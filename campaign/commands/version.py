"""`campaign --version`: what takes part in a result."""

import argparse

from campaign.terminal import say


class PrintVersion(argparse.Action):
    """Prints the versions, which takes half a second to find out, only where they are asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Print them and end."""
        say(version())
        parser.exit()


def version() -> str:
    """Return the versions of this program, its sources and the libraries that matter, a line each."""
    import h5py

    import campaign
    from campaign.running.mpi_library import mpi_library
    from campaign.storage.provenance import library_versions, source_hashes

    libraries = library_versions()
    sources = source_hashes()
    lines = {
        "runout-campaign": campaign.__version__,
        "realizations": f"{sources['realization_sha256'][:12]} (SHA-256 of the program that decides them)",
        "solver": f"{sources['solver_sha256'][:12]} (SHA-256 of its program)",
        "MPI": mpi_library(),
        "Numba": libraries["numba"],
        "NumPy": libraries["numpy"],
        "HDF5": f"{h5py.version.hdf5_version} (h5py {libraries['h5py']})",
        "Python": libraries["python"],
    }
    return "\n".join(f"{name:16} {text}" for name, text in lines.items())
