"""Moving particles as a VTKHDF file, which ParaView (from 5.12) and VTK (from 9.3) open as an animation.

Version 2.0 of the format: an unstructured grid of vertices with a group `Steps`, which tells for each time step where
in the arrays, all steps end to end, its points and values begin. What does not change is kept once, at offset 0.
Numbers are kept in single precision, which is all a picture needs.
https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/vtkhdf_specifications.html
"""

from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from campaign.files import publish, temporary_name

Array = NDArray[np.float64]

VERTEX = 1
"""VTK's number of the cell that is one point."""

COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 4, "shuffle": True}


class ParticleFile:
    """Writes a file step by step; under its own name it appears when it is closed, whole as far as it got.

    Parameters
    ----------
    path : Path
    fixed : mapping of str to array (n,)
        What each of the `n` particles keeps for all times.
    """

    def __init__(self, path: Path, fixed: Mapping[str, Array]) -> None:
        self._path = path
        self._temporary = temporary_name(path)
        self._file = h5py.File(self._temporary, "w")
        self._fixed = fixed
        self._steps = 0
        self._size = next(iter(fixed.values())).size
        self._root = self._file.create_group("VTKHDF")
        self._write_frame()

    def __enter__(self) -> "ParticleFile":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            self._file.close()
            if self._steps > 0:
                publish(self._temporary, self._path)
        finally:
            self._temporary.unlink(missing_ok=True)

    def append(self, time: float, points: Array, values: Mapping[str, Array]) -> None:
        """Add a time step.

        Parameters
        ----------
        time : float
            In s.
        points : array (n, 3)
            In m.
        values : mapping of str to array (n,) or (n, components)
            The same names at every step.
        """
        steps, begin = self._root["Steps"], self._steps * self._size
        _extend(self._root, "Points", _single(points))
        _extend(steps, "Values", np.array([time]))
        _extend(steps, "PointOffsets", np.array([begin]))
        _extend(steps, "NumberOfParts", np.array([1]))
        for name, width in (("PartOffsets", ()), ("CellOffsets", (1,)), ("ConnectivityIdOffsets", (1,))):
            _extend(steps, name, np.zeros((1, *width), dtype=np.int64))
        for name, array in values.items():
            _extend(self._root["PointData"], name, _single(array))
            _extend(steps["PointDataOffsets"], name, np.array([begin]))
        for name in self._fixed:
            _extend(steps["PointDataOffsets"], name, np.array([0]))
        self._steps += 1
        steps.attrs["NSteps"] = self._steps

    def _write_frame(self) -> None:
        root, n = self._root, self._size
        root.attrs["Version"] = np.array([2, 0])
        # The reader wants a string of fixed length.
        root.attrs["Type"] = np.bytes_("UnstructuredGrid")
        for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"):
            root[name] = np.array([n])
        root["Connectivity"] = np.arange(n)
        root["Offsets"] = np.arange(n + 1)
        root["Types"] = np.full(n, VERTEX, dtype=np.uint8)
        values = root.create_group("PointData")
        for name, array in self._fixed.items():
            values.create_dataset(name, data=_single(array), **COMPRESSION)
        root.create_group("Steps").create_group("PointDataOffsets")
        root["Steps"].attrs["NSteps"] = 0


def _single(array: Array) -> NDArray[np.float32]:
    return array.astype(np.float32)


def _extend(group: Any, name: str, rows: NDArray[Any]) -> None:
    """Append rows to a dataset; a step of it is a chunk."""
    if name not in group:
        group.create_dataset(name, data=rows, maxshape=(None, *rows.shape[1:]), chunks=rows.shape, **COMPRESSION)
        return
    dataset = group[name]
    dataset.resize(dataset.shape[0] + rows.shape[0], axis=0)
    dataset[-rows.shape[0] :] = rows
