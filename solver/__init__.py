"""Material point solver for one landslide: deterministic, serial, and free of files, MPI and random numbers."""
