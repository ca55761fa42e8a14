# SPDX-License-Identifier: BSD-3-Clause
"""Grids of several times as a source of a VTK pipeline."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkStructuredGrid
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from ._coordinates import epoch_seconds


class Series(VTKPythonAlgorithmBase):  # type: ignore[misc]
    """A source with time steps. Raises ValueError if they do not rise, or a grid has none."""

    def __init__(self, grids: Sequence[vtkStructuredGrid]):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkStructuredGrid")
        self.grids = list(grids)
        key = vtkDataObject.DATA_TIME_STEP()
        for n, grid in enumerate(self.grids):
            if not isinstance(grid, vtkStructuredGrid):
                raise TypeError(f"number {n} of the grids is a {type(grid).__name__}; vtkStructuredGrid is needed")
            if not grid.GetInformation().Has(key):
                raise ValueError(f"number {n} of the grids has no time; give grid(..., time=...)")
        self.times = [grid.GetInformation().Get(key) for grid in self.grids]
        if not self.times or any(b <= a for a, b in zip(self.times, self.times[1:])):
            raise ValueError(f"the grids' times {self.times} do not rise; sort them")

    def seconds(self, time: Any) -> float:
        """Of an index (int), seconds (float) or a date."""
        if isinstance(time, (int, np.integer)):
            if not -len(self.times) <= time < len(self.times):
                raise ValueError(f"{time} is no index of {len(self.times)} grids")
            return float(self.times[time])
        seconds = epoch_seconds(time)
        if not self.times[0] <= seconds <= self.times[-1]:
            raise ValueError(f"{time!r} is no time within the grids', {self.times[0]} to {self.times[-1]} s")
        return seconds

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        """The times and the extent."""
        sddp, out = vtkStreamingDemandDrivenPipeline, outputs.GetInformationObject(0)
        out.Set(sddp.WHOLE_EXTENT(), self.grids[0].GetExtent(), 6)
        out.Set(sddp.TIME_STEPS(), self.times, len(self.times))
        out.Set(sddp.TIME_RANGE(), [self.times[0], self.times[-1]], 2)
        return 1

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        """The grid nearest to the requested time."""
        out = outputs.GetInformationObject(0)
        key = vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        wanted = out.Get(key) if out.Has(key) else self.times[0]
        nearest = int(np.argmin(np.abs(np.subtract(self.times, wanted))))
        output = vtkStructuredGrid.GetData(outputs, 0)
        output.ShallowCopy(self.grids[nearest])
        output.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), self.times[nearest])
        return 1
