// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudVoxelVolume.h"

#include "Camera.h"
#include "CloudArrays.h"
#include "DeepTile.h"
#include "PhaseFunction.h"
#include "VoxelTree.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkCloudVoxelVolume);

namespace
{
namespace arrays = nephoscope::arrays;
using nephoscope::Vector3;

// A segment ends once it holds so much: other translucent bodies mix with it as with a uniform medium.
constexpr double SegmentDepth = 0.25;

// A ray ends where less gets through.
constexpr double Nothing = 1e-4;
}

struct vtkCloudVoxelVolume::Internals
{
  nephoscope::VoxelTree Tree;
  vtkMTimeType Read = 0;
  Vector3 Rows[3] = {}; ///< from scene to index space
  Vector3 Shift{ 0, 0, 0 };
  Vector3 Sun{ 0, 0, 0 }; ///< toward it in index space, per scene unit; as swept

  Vector3 Turn(const Vector3& v) const
  {
    return { dot(this->Rows[0], v), dot(this->Rows[1], v), dot(this->Rows[2], v) };
  }
};

namespace
{
/// A ray of the scene as the tree sees it, and what its segments become.
class VoxelRay
{
public:
  VoxelRay(const nephoscope::VoxelTree& tree, const Vector3& origin, const Vector3& direction,
    double scale, double hidden)
    : Tree(tree)
    , Origin(origin)
    , Direction(direction)
    , Scale(scale)
    , Hidden(hidden)
  {
  }

  /// Calls emit(near, far, light) for each segment.
  template <class Emit>
  void draw(const Emit& emit)
  {
    this->Tree.walk(this->Origin, this->Direction, 0, this->Hidden,
      [this, &emit](std::size_t brick, double near, double far)
      {
        if (this->Open && near > this->Far)
        {
          this->close(emit);
        }
        this->Near = this->Open ? this->Near : near;
        this->Open = true;
        this->Far = far;
        this->Tree.shine(brick, this->Origin, this->Direction, near, far, this->Scale, this->Light);
        if (this->Light.transmittance < std::exp(-SegmentDepth))
        {
          this->close(emit);
        }
        return this->Through > Nothing;
      });
    if (this->Open)
    {
      this->close(emit);
    }
  }

private:
  template <class Emit>
  void close(const Emit& emit)
  {
    if (this->Light.transmittance < 1)
    {
      emit(this->Near, this->Far, this->Light);
      this->Through *= this->Light.transmittance;
    }
    this->Light = {};
    this->Open = false;
  }

  const nephoscope::VoxelTree& Tree;
  const Vector3& Origin;
  const Vector3& Direction;
  double Scale;
  double Hidden;
  nephoscope::VoxelLight Light;
  bool Open = false;
  double Near = 0;
  double Far = 0;
  double Through = 1;
};
}

vtkCloudVoxelVolume::vtkCloudVoxelVolume()
  : Data(std::make_unique<Internals>())
{
}

vtkCloudVoxelVolume::~vtkCloudVoxelVolume() = default;

int vtkCloudVoxelVolume::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

vtkIdType vtkCloudVoxelVolume::GetNumberOfDrawnCells() const
{
  return static_cast<vtkIdType>(this->Data->Tree.numberOfBricks());
}

bool vtkCloudVoxelVolume::ReadBricks()
{
  auto* const input = vtkPolyData::SafeDownCast(this->GetInputDataObject(0, 0));
  vtkPointData* const points = input ? input->GetPointData() : nullptr;
  auto* const values =
    vtkFloatArray::SafeDownCast(points ? points->GetArray(arrays::VoxelBricks) : nullptr);
  auto* const origins =
    vtkIntArray::SafeDownCast(points ? points->GetArray(arrays::VoxelOrigins) : nullptr);
  vtkDataArray* const matrix =
    input ? input->GetFieldData()->GetArray(arrays::VoxelToScene) : nullptr;
  if (!values || !origins || !matrix || values->GetNumberOfComponents() != 512 ||
    origins->GetNumberOfComponents() != 3 || matrix->GetNumberOfValues() != 16 ||
    values->GetNumberOfTuples() != origins->GetNumberOfTuples())
  {
    vtkErrorMacro("The input has no bricks of scalar voxels: "
      << arrays::VoxelBricks << " (512 floats), " << arrays::VoxelOrigins << " (3 ints) and "
      << arrays::VoxelToScene << " (16 numbers); connect a vtkCloudVDBReader that gives bricks.");
    return false;
  }
  double forward[16];
  double inverse[16];
  for (int n = 0; n < 16; ++n)
  {
    forward[n] = matrix->GetComponent(
      n / matrix->GetNumberOfComponents(), n % matrix->GetNumberOfComponents());
  }
  const double volume = vtkMatrix4x4::Determinant(forward);
  if (!std::isfinite(volume) || volume == 0)
  {
    vtkErrorMacro(
      "The field data's " << arrays::VoxelToScene << " cannot be inverted; give voxels a volume.");
    return false;
  }
  vtkMatrix4x4::Invert(forward, inverse);
  for (int c = 0; c < 3; ++c)
  {
    this->Data->Rows[c] = { inverse[4 * c], inverse[4 * c + 1], inverse[4 * c + 2] };
    this->Data->Shift[c] = inverse[4 * c + 3];
  }
  std::vector<std::array<int, 3>> places(static_cast<std::size_t>(origins->GetNumberOfTuples()));
  for (std::size_t b = 0; b < places.size(); ++b)
  {
    origins->GetTypedTuple(static_cast<vtkIdType>(b), places[b].data());
  }
  if (nephoscope::VoxelTree::numberOfBlocks(places) > nephoscope::VoxelTree::MostBlocks)
  {
    vtkErrorMacro("The " << places.size()
                         << " bricks lie too far apart for a table of blocks of 64 voxels; draw "
                            "distant clouds as bodies of their own.");
    return false;
  }
  this->Data->Tree = nephoscope::VoxelTree(places, values->GetPointer(0));
  return true;
}

void vtkCloudVoxelVolume::SweepSun()
{
  nephoscope::VoxelTree& tree = this->Data->Tree;
  tree.setSun(this->Data->Sun);
  for (std::size_t wave = 0; wave < tree.numberOfWaves(); ++wave)
  {
    vtkSMPTools::For(static_cast<vtkIdType>(tree.waveBegin(wave)),
      static_cast<vtkIdType>(tree.waveBegin(wave + 1)), 1,
      [&tree](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType place = begin; place < end; ++place)
        {
          tree.sweep(static_cast<std::size_t>(place));
        }
      });
  }
}

bool vtkCloudVoxelVolume::Prepare(const nephoscope::Camera&)
{
  vtkDataObject* const input = this->GetInputDataObject(0, 0);
  const vtkMTimeType newest = input ? input->GetMTime() : 0;
  const bool fresh = !input || newest != this->Data->Read;
  if (fresh && !this->ReadBricks())
  {
    this->Data->Tree = {};
    this->Data->Read = 0;
    return false;
  }
  this->Data->Read = newest;
  const Vector3 toward =
    nephoscope::normalized(Vector3{ this->TowardSun[0], this->TowardSun[1], this->TowardSun[2] });
  const Vector3 sun = this->Data->Turn(toward);
  if (!(length(sun) > 0))
  {
    vtkErrorMacro("TowardSun is no direction; give one.");
    return false;
  }
  const Vector3& last = this->Data->Sun;
  if (fresh || sun[0] != last[0] || sun[1] != last[1] || sun[2] != last[2])
  {
    this->Data->Sun = sun;
    this->SweepSun();
  }
  return true;
}

void vtkCloudVoxelVolume::Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  const nephoscope::TileExtent& e = tile.extent();
  const Internals& data = *this->Data;
  const Vector3 towardSun =
    nephoscope::normalized(Vector3{ this->TowardSun[0], this->TowardSun[1], this->TowardSun[2] });
  for (int y = e.y0; y < e.y0 + e.height; ++y)
  {
    for (int x = e.x0; x < e.x0 + e.width; ++x)
    {
      const nephoscope::Ray ray = camera.ray(x + 0.5, y + 0.5);
      const Vector3 origin = data.Turn(ray.origin) + data.Shift;
      const Vector3 direction = data.Turn(ray.direction);
      // Light that travels away from the sun and then against the ray.
      const double mu = dot(towardSun, ray.direction);
      const double phase = 4 * vtkMath::Pi() * nephoscope::henyeyGreenstein(this->Asymmetry, mu);
      VoxelRay voxels(data.Tree, origin, direction, this->ExtinctionScale, tile.opaqueAt(x, y));
      voxels.draw(
        [&](double near, double far, const nephoscope::VoxelLight& light)
        {
          nephoscope::Segment segment;
          segment.nearEnd = near;
          segment.farEnd = far;
          const double depth = -std::log(std::max(light.transmittance, 1e-300));
          for (std::size_t c = 0; c < 3; ++c)
          {
            segment.opticalDepth[c] = static_cast<float>(depth);
            segment.radiance[c] = static_cast<float>(this->Albedo *
              (this->SunColor[c] * (1 - this->Ambient) * phase * light.light +
                this->SkyColor[c] * this->Ambient * (1 - light.transmittance)));
          }
          tile.add(x, y, segment);
        });
    }
  }
}

void vtkCloudVoxelVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ExtinctionScale: " << this->ExtinctionScale << '\n';
  os << indent << "Albedo: " << this->Albedo << '\n';
  os << indent << "Asymmetry: " << this->Asymmetry << '\n';
}
