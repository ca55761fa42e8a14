// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Tetrahedra.h
 * @brief A structured grid's cells as the tetrahedra that the contour works on.
 */
#ifndef Tetrahedra_h
#define Tetrahedra_h

#include <vtkSmartPointer.h>

class vtkStructuredGrid;
class vtkUnstructuredGrid;

namespace nephoscope::program
{
/// Five tetrahedra a cell (TetrahedralSplit.h), positively oriented where the grid is right-handed. Points, point arrays and
/// field data are shared with the grid.
vtkSmartPointer<vtkUnstructuredGrid> tetrahedraOf(vtkStructuredGrid* grid);
}
#endif
