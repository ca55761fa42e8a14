// SPDX-License-Identifier: BSD-3-Clause
#include "LandMask.h"

#include "vtkCellArray.h"
#include "vtkEarthSource.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr int LinesPerRow = 4;

/// Difference of two longitudes, the short way round.
double shortWay(double degrees)
{
  return degrees - 360 * std::round(degrees / 360);
}
}

const LandMask& LandMask::earth()
{
  static const LandMask mask;
  return mask;
}

LandMask::LandMask()
  : Land(static_cast<std::size_t>(Columns) * Rows, 0)
{
  vtkNew<vtkEarthSource> source;
  source->SetOnRatio(1);
  source->SetRadius(1);
  source->OutlineOff();
  source->Update();
  vtkPolyData* const coasts = source->GetOutput();
  vtkCellArray* const polygons = coasts->GetPolys();
  for (vtkIdType cell = 0; cell < polygons->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* ids;
    polygons->GetCellAtId(cell, size, ids);
    Outline outline;
    for (vtkIdType i = 0; i <= size; ++i)
    {
      double p[3];
      coasts->GetPoint(ids[i % size], p);
      const double longitude = vtkMath::DegreesFromRadians(std::atan2(p[1], p[0]));
      const double before = i > 0 ? outline.longitude.back() : longitude;
      outline.longitude.push_back(before + shortWay(longitude - before));
      outline.latitude.push_back(
        vtkMath::DegreesFromRadians(std::asin(std::clamp(p[2], -1.0, 1.0))));
    }
    if (std::abs(outline.longitude.back() - outline.longitude.front()) > 180)
    {
      // It goes round a pole: close it there.
      const double pole = outline.latitude.front() < 0 ? -90 : 90;
      outline.longitude.insert(
        outline.longitude.end(), { outline.longitude.back(), outline.longitude.front() });
      outline.latitude.insert(outline.latitude.end(), { pole, pole });
    }
    this->fill(outline);
  }
}

void LandMask::fill(const Outline& outline)
{
  // Where each line is crossed, edge by edge.
  constexpr double LinesPerDegree = LinesPerRow / Cell;
  std::vector<std::vector<double>> crossings(Rows * LinesPerRow);
  const std::size_t corners = outline.longitude.size();
  for (std::size_t i = 0; i < corners; ++i)
  {
    const std::size_t j = (i + 1) % corners;
    const double a = (outline.latitude[i] + 90) * LinesPerDegree - 0.5;
    const double b = (outline.latitude[j] + 90) * LinesPerDegree - 0.5;
    const int first = std::max(0, static_cast<int>(std::ceil(std::min(a, b))));
    for (int line = first; line < std::max(a, b) && line < Rows * LinesPerRow; ++line)
    {
      crossings[line].push_back(outline.longitude[i] +
        (line - a) / (b - a) * (outline.longitude[j] - outline.longitude[i]));
    }
  }
  for (int line = 0; line < Rows * LinesPerRow; ++line)
  {
    std::vector<double>& places = crossings[line];
    std::sort(places.begin(), places.end());
    for (std::size_t i = 1; i < places.size(); i += 2)
    {
      this->fillSpan(line / LinesPerRow, (places[i - 1] + 180) / Cell, (places[i] + 180) / Cell,
        1.0 / LinesPerRow);
    }
  }
}

/// Add weight times the share of each cell that lies between two columns, which may be beyond the seam.
void LandMask::fillSpan(int row, double from, double to, double weight)
{
  for (double column = std::floor(from); column < to; column += 1)
  {
    const double share = std::min(to, column + 1) - std::max(from, column);
    const int wrapped = ((static_cast<int>(column) % Columns) + Columns) % Columns;
    float& land = this->Land[static_cast<std::size_t>(row) * Columns + wrapped];
    land = std::min(1.0F, land + static_cast<float>(weight * share));
  }
}

double LandMask::landAt(double longitude, double latitude, double footprint) const
{
  const double x = (longitude + 180) / Cell - 0.5;
  const double y = std::clamp((latitude + 90) / Cell - 0.5, 0.0, Rows - 1.0);
  const double column = std::floor(x);
  const int i = static_cast<int>(column - Columns * std::floor(column / Columns)) % Columns;
  const int next = (i + 1) % Columns;
  const int j = std::min(static_cast<int>(y), Rows - 2);
  const double u = x - column;
  const double v = y - j;
  const double land = (1 - v) * ((1 - u) * this->at(i, j) + u * this->at(next, j)) +
    v * ((1 - u) * this->at(i, j + 1) + u * this->at(next, j + 1));
  const double contrast = footprint > 0 ? std::max(1.0, Cell / footprint) : 1;
  return std::clamp(0.5 + contrast * (land - 0.5), 0.0, 1.0);
}
}
