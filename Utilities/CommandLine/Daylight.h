// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Daylight.h
 * @brief The light that clouds around a globe have of the sun.
 */
#ifndef Daylight_h
#define Daylight_h

#include <SurfaceShade.h>
#include <vtkSmartPointer.h>

class vtkStructuredGrid;

namespace nephoscope::program
{
/**
 * The grid with the point array SourceColor: what a level cloud top at each point sends up in the shade's light, so that a
 * volume is bright by day and dim by night. There are no shadows of one cloud on another.
 * @param grid around a globe whose centre is the origin
 */
vtkSmartPointer<vtkStructuredGrid> inDaylight(vtkStructuredGrid* grid, const SurfaceShade& shade);
}
#endif
