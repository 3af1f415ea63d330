"""What tests of campaigns under MPI share."""

import pytest
from stand_in_campaign import dataset_of


@pytest.fixture(scope="session")
def alone(tmp_path_factory):
    """The dataset of a campaign that one rank has computed undisturbed."""
    return dataset_of(tmp_path_factory.mktemp("alone") / "out", ranks=1)
