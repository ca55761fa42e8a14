// SPDX-License-Identifier: BSD-3-Clause
#include "CloudPanorama.h"

#include "ArcTangent.h"
#include "vtkSMPTools.h"

#include <cmath>
#include <vector>

namespace nephoscope
{
namespace
{
constexpr int Round = 1200; ///< directions all round
constexpr int Up = 301;     ///< from the horizon to the zenith
constexpr int Margin = 64; ///< directions that are there twice, so that what is blurred has no seam
constexpr int Columns = Round + 2 * Margin + 1;

/// Works slices out and stores them wherever they are.
struct Panel
{
  const HeightField& field;
  double planeHeight;
  const ScatteringDensities& densities;
  CloudSlice slice;
  std::vector<double> slopes;
  std::vector<float> lights = std::vector<float>(static_cast<std::size_t>(Columns) * Up);
  std::vector<float> transmittances = std::vector<float>(static_cast<std::size_t>(Columns) * Up);

  void operator()(vtkIdType begin, vtkIdType end)
  {
    const auto method = HeightFieldScattering::make("Moments", field, planeHeight, densities);
    SliceLight light;
    for (vtkIdType n = begin; n < end; ++n)
    {
      CloudSlice here = this->slice;
      here.ux = std::cos(static_cast<double>(n) * CloudPanorama::Spacing);
      here.uy = std::sin(static_cast<double>(n) * CloudPanorama::Spacing);
      method->shine(here, this->slopes, light);
      for (vtkIdType column = n + Margin - Round; column < Columns; column += Round)
      {
        for (vtkIdType row = 0; row < Up && column >= 0; ++row)
        {
          const RayLight& ray = light.rays[static_cast<std::size_t>(row)];
          this->lights[row * Columns + column] = static_cast<float>(ray.light);
          this->transmittances[row * Columns + column] = static_cast<float>(ray.transmittance);
        }
      }
    }
  }
};
}

CloudPanorama::CloudPanorama(const HeightField& field, double planeHeight,
  const ScatteringDensities& densities, const Vector3& eye, double far)
  : Eye(eye)
  , PlaneHeight(planeHeight)
{
  CloudSlice slice;
  slice.x = eye[0];
  slice.y = eye[1];
  slice.z = eye[2];
  slice.far = far;
  slice.growth = Spacing;
  Panel panel{ field, planeHeight, densities, slice, {} };
  for (int row = 0; row < Up; ++row)
  {
    panel.slopes.push_back(std::tan(std::min(row * Spacing, 1.5707)));
  }
  vtkSMPTools::For(0, Round, panel);
  const GridFrame frame{ -Margin * Spacing, 0, Spacing, Spacing, Columns, Up };
  this->Lights = GridPyramid(frame, std::move(panel.lights));
  this->Transmittances = GridPyramid(frame, std::move(panel.transmittances));
}

CloudPanorama::Light CloudPanorama::at(
  const Vector3& from, const Vector3& direction, double blur) const
{
  const double way = (this->PlaneHeight - from[2]) / direction[2];
  if (!(way > 0))
  {
    return { 0, 1 };
  }
  const Vector3 seen = from + way * direction - this->Eye;
  const double azimuth = arcTangent(seen[1], seen[0]);
  const double x = azimuth < 0 ? azimuth + Round * Spacing : azimuth;
  const double y = arcTangent(seen[2], std::sqrt(seen[0] * seen[0] + seen[1] * seen[1]));
  return { this->Lights.value(x, y, blur), this->Transmittances.value(x, y, blur) };
}
}
