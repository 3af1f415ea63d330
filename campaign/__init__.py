"""Monte-Carlo campaigns of landslide run-out: scenes, random fields, the MPI runner, and statistics."""
