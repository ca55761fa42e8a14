// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudSurface.h"

#include "CloudTexture.h"
#include "DeepTile.h"
#include "RayTriangle.h"
#include "SurfaceShade.h"
#include "TriangleBins.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <cmath>

vtkStandardNewMacro(vtkCloudSurface);

namespace
{
using nephoscope::Vector3;

/// A pixel on a slanted surface is counted as at most this many times longer.
constexpr double LargestSlant = 8;
/// Corners are numbered in 32 bits.
constexpr vtkIdType MostPoints = 0xffffffff;

/// Weights of the corners of a triangle.
struct Weights
{
  double a, b, c;
  double number(double fa, double fb, double fc) const
  {
    return this->a * fa + this->b * fb + this->c * fc;
  }
  template <class Triple>
  Vector3 vector(const Triple& fa, const Triple& fb, const Triple& fc) const
  {
    return { this->number(fa[0], fb[0], fc[0]), this->number(fa[1], fb[1], fc[1]),
      this->number(fa[2], fb[2], fc[2]) };
  }
};

float opticalDepthOf(double opacity)
{
  return opacity < 1 ? static_cast<float>(-std::log1p(-opacity)) : nephoscope::Opaque;
}
}

/// What Prepare gets ready for Emit.
struct vtkCloudSurface::Drawing
{
  nephoscope::TriangleMesh Mesh;
  vtkMTimeType MeshTime = 0;
  const void* MeshOf = nullptr;
  nephoscope::TriangleBins Bins;
  nephoscope::SurfaceShade Shade;
  nephoscope::CloudTexture Texture;
  int Mode = UniformOpacity;
  double MaximumOpacity = 1;

  void UpdateMesh(vtkPolyData* data)
  {
    if (this->MeshTime != data->GetMTime() || this->MeshOf != data)
    {
      this->Mesh.assign(data);
      this->MeshTime = data->GetMTime();
      this->MeshOf = data;
    }
  }

  void Shoot(const nephoscope::Camera& camera, int x, int y, std::uint32_t triangle,
    nephoscope::DeepTile& tile) const;

private:
  struct Hit
  {
    const nephoscope::TriangleMesh::Corners& Corners;
    Weights At;
    double Distance;
    Vector3 Normal;    // unit, on the side that is seen
    Vector3 TowardEye; // unit
  };
  Vector3 NormalAt(const Hit& hit) const;
  double TexturePerScene(const nephoscope::TriangleMesh::Corners& corners,
    const std::vector<Vector3>& coordinates) const;
  double TextureAt(const Hit& hit, double footprint) const;
  double OpacityAt(const Hit& hit, double pixel, double& textureValue) const;
};

/// Interpolated and of unit length; that of the flat triangle where there is none. Turned if the far side is seen.
Vector3 vtkCloudSurface::Drawing::NormalAt(const Hit& hit) const
{
  const auto& [a, b, c] = hit.Corners;
  const auto& p = this->Mesh.points;
  const Vector3 flat = nephoscope::cross(p[b] - p[a], p[c] - p[a]);
  Vector3 normal = flat;
  if (!this->Mesh.normals.empty())
  {
    const auto& n = this->Mesh.normals;
    const Vector3 smooth = nephoscope::normalized(hit.At.vector(n[a], n[b], n[c]));
    // Also false for NaN.
    normal = dot(smooth, smooth) > 0.5 ? smooth : flat;
  }
  return nephoscope::normalized(dot(flat, hit.TowardEye) < 0 ? -1.0 * normal : normal);
}

/// Metres of texture for a scene unit: of the edge that is stretched most.
double vtkCloudSurface::Drawing::TexturePerScene(
  const nephoscope::TriangleMesh::Corners& corners, const std::vector<Vector3>& coordinates) const
{
  double most = 0;
  for (int i = 0; i < 3; ++i)
  {
    const auto from = corners[i];
    const auto to = corners[(i + 1) % 3];
    const double scene = length(this->Mesh.points[to] - this->Mesh.points[from]);
    const double texture = length(coordinates[to] - coordinates[from]);
    most = scene > 0 ? std::max(most, texture / scene) : most;
  }
  return most;
}

/// The texture at a hit: of its place, of its coordinates, or of two pairs of them that are cross-faded.
double vtkCloudSurface::Drawing::TextureAt(const Hit& hit, double footprint) const
{
  const auto& [a, b, c] = hit.Corners;
  const auto at = [&hit, a = a, b = b, c = c](const std::vector<Vector3>& of)
  { return hit.At.vector(of[a], of[b], of[c]); };
  const nephoscope::TriangleMesh& mesh = this->Mesh;
  if (mesh.texturePoints.empty())
  {
    return this->Texture.value(at(mesh.points).v, footprint);
  }
  const double first = this->TexturePerScene(hit.Corners, mesh.texturePoints);
  if (mesh.otherTexturePoints.empty())
  {
    return this->Texture.value(at(mesh.texturePoints).v, footprint * first);
  }
  const double second = this->TexturePerScene(hit.Corners, mesh.otherTexturePoints);
  const double weight = mesh.textureWeight;
  return this->Texture.blended(at(mesh.texturePoints).v, at(mesh.otherTexturePoints).v, weight,
    footprint * (weight * first + (1 - weight) * second));
}

/// The opacity of a hit, and the texture's value if there is a texture. `pixel` is its width there, scene units.
double vtkCloudSurface::Drawing::OpacityAt(const Hit& hit, double pixel, double& textureValue) const
{
  const auto& [a, b, c] = hit.Corners;
  const nephoscope::TriangleMesh& mesh = this->Mesh;
  double opacity = 1;
  if (this->Mode == OpacityFromArray && !mesh.opacities.empty())
  {
    opacity = hit.At.number(mesh.opacities[a], mesh.opacities[b], mesh.opacities[c]);
  }
  else if (this->Mode == OpacityFromTexture)
  {
    const double facing = std::abs(dot(hit.Normal, hit.TowardEye));
    textureValue = this->TextureAt(hit, pixel / std::max(facing, 1 / LargestSlant));
    opacity = this->Texture.opacityOf(textureValue, facing * facing);
  }
  opacity *= this->MaximumOpacity;
  return opacity > 0 ? std::min(opacity, 1.0) : 0; // 0 for NaN
}

/// The ray of a pixel that meets a triangle.
void vtkCloudSurface::Drawing::Shoot(const nephoscope::Camera& camera, int x, int y,
  std::uint32_t triangle, nephoscope::DeepTile& tile) const
{
  const nephoscope::TriangleMesh::Corners& corners = this->Mesh.triangles[triangle];
  const auto& p = this->Mesh.points;
  const nephoscope::Ray ray = camera.ray(x + 0.5, y + 0.5);
  const nephoscope::TriangleHit at =
    nephoscope::intersect(ray, p[corners[0]], p[corners[1]], p[corners[2]]);
  if (!(at.distance >= 0) || at.distance > tile.opaqueAt(x, y))
  {
    return;
  }
  Hit hit{ corners, { 1 - at.b - at.c, at.b, at.c }, at.distance, {}, -1.0 * ray.direction };
  hit.Normal = this->NormalAt(hit);
  double textureValue = 0;
  const double opacity = this->OpacityAt(hit, camera.footprint(at.distance), textureValue);
  if (opacity > 0)
  {
    nephoscope::RGB light =
      this->Shade(hit.Normal, hit.TowardEye, std::clamp(textureValue, 0.0, 1.0));
    for (float& channel : light)
    {
      channel *= static_cast<float>(opacity);
    }
    const float depth = opticalDepthOf(opacity);
    tile.add(x, y, { at.distance, at.distance, { depth, depth, depth }, light });
  }
}

vtkCloudSurface::vtkCloudSurface()
  : Ready(std::make_unique<Drawing>())
{
}

vtkCloudSurface::~vtkCloudSurface() = default;

int vtkCloudSurface::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

bool vtkCloudSurface::Prepare(const nephoscope::Camera& camera)
{
  if (!this->IsFlat(camera))
  {
    return false;
  }
  vtkPolyData* const data = vtkPolyData::SafeDownCast(this->GetInputDataObject(0, 0));
  if (!data)
  {
    vtkErrorMacro(
      "The input is not vtkPolyData: connect a contour, such as that of vtkCloudContour.");
    return false;
  }
  if (data->GetNumberOfPoints() > MostPoints ||
    data->GetPolys()->GetNumberOfConnectivityIds() > MostPoints)
  {
    vtkErrorMacro("The input has "
      << data->GetNumberOfPoints() << " points and " << data->GetNumberOfPolys()
      << " polygons, more than fit 32-bit numbers: draw it in pieces.");
    return false;
  }
  Drawing& ready = *this->Ready;
  ready.UpdateMesh(data);
  ready.Bins.build(ready.Mesh, camera, this->BackFaces);
  ready.Mode = this->OpacityMode;
  ready.MaximumOpacity = this->Opacity;
  ready.Shade = this->MakeShade();
  ready.Shade.color = { this->Color[0], this->Color[1], this->Color[2] };
  ready.Shade.wrap = this->Wrap;
  ready.Shade.specular = this->Specular;
  ready.Shade.specularPower = this->SpecularPower;
  if (this->OpacityMode == OpacityFromTexture)
  {
    ready.Shade.texture = this->TextureShading;
    nephoscope::CloudTextureParameters parameters;
    parameters.wavelength = this->TextureWavelength;
    parameters.octaves = this->TextureOctaves;
    parameters.offset = this->TextureOffset;
    parameters.threshold = this->TextureThreshold;
    parameters.rimThreshold = this->TextureRimThreshold;
    parameters.range = this->TextureRange;
    parameters.seed = static_cast<std::uint32_t>(this->TextureSeed);
    ready.Texture = nephoscope::CloudTexture(parameters);
  }
  return true;
}

void vtkCloudSurface::Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  const nephoscope::TileExtent& e = tile.extent();
  const Drawing& ready = *this->Ready;
  if (ready.MaximumOpacity <= 0)
  {
    return;
  }
  ready.Bins.forEach({ e.x0, e.x0 + e.width, e.y0, e.y0 + e.height },
    [&ready, &camera, &tile](
      const nephoscope::TriangleBins::Entry& entry, const nephoscope::PixelRectangle& limits)
    {
      entry.shape.forEachPixel(limits,
        [&ready, &camera, &tile, &entry](int x, int y)
        { ready.Shoot(camera, x, y, entry.triangle, tile); });
    });
}

bool vtkCloudSurface::IsOpaque() const
{
  return this->OpacityMode == UniformOpacity && this->Opacity >= 1;
}

vtkIdType vtkCloudSurface::GetNumberOfDrawnCells() const
{
  return static_cast<vtkIdType>(this->Ready->Bins.numberOfTriangles());
}

void vtkCloudSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OpacityMode: " << this->OpacityMode << '\n';
  os << indent << "Opacity: " << this->Opacity << '\n';
  os << indent << "Color: " << this->Color[0] << ' ' << this->Color[1] << ' ' << this->Color[2]
     << '\n';
  os << indent << "BackFaces: " << this->BackFaces << '\n';
  os << indent << "Wrap: " << this->Wrap << '\n';
  os << indent << "TextureShading: " << this->TextureShading << '\n';
  os << indent << "Specular: " << this->Specular << '\n';
  os << indent << "SpecularPower: " << this->SpecularPower << '\n';
  os << indent << "TextureWavelength: " << this->TextureWavelength << '\n';
  os << indent << "TextureOctaves: " << this->TextureOctaves << '\n';
  os << indent << "TextureOffset: " << this->TextureOffset << '\n';
  os << indent << "TextureThreshold: " << this->TextureThreshold << '\n';
  os << indent << "TextureRimThreshold: " << this->TextureRimThreshold << '\n';
  os << indent << "TextureRange: " << this->TextureRange << '\n';
  os << indent << "TextureSeed: " << this->TextureSeed << '\n';
}
