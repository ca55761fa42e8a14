// SPDX-License-Identifier: BSD-3-Clause
// The cloud's shell laid out as a map and made voxels of an OpenVDB file: vtkCloudVDBWriter, which writes means over voxels, against VTK's
// resampling at their centres, the way of those who have VTK alone (Debian's VTK cannot write OpenVDB, so its image goes through
// vtkCloudVDBWriter too, which keeps such voxels as they are). A run ends with the file on the disk. Voxels are 1/n of a cell along longitude
// and latitude and 2/n of a level high. Figures: error, the RMS of voxels against means of the closed form over them, as a share of the RMS
// of these; massError, of the sum of all voxels, as a share of the integral over the cells.
#include "BrickSampler.h"
#include "CloudArrays.h"
#include "ShellCase.h"
#include "TetrahedralSplit.h"

#include "vtkCloudVDBReader.h"
#include "vtkCloudVDBWriter.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkResampleToImage.h"
#include "vtkStructuredData.h"
#include "vtkStructuredGrid.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numeric>
#include <stdexcept>

namespace nephoscope
{
namespace performance
{
namespace
{
constexpr double Pi = 3.14159265358979323846;

/// Longitude, latitude and height above the globe of radius 1.
Vector3 onMap(const Vector3& position)
{
  const double r = length(position);
  return { std::atan2(position[1], position[0]), std::asin(position[2] / r), r - 1 };
}

/// The closed form at a place of the map; 0 outside the shell.
double fractionAt(const Vector3& map)
{
  const double r = 1 + map[2];
  const shell::Place place = shell::place({ r * std::cos(map[1]) * std::cos(map[0]),
    r * std::cos(map[1]) * std::sin(map[0]), r * std::sin(map[1]) });
  return place.eta >= 0 && place.eta <= 1 ? shell::cloudFraction(place) : 0;
}

vtkSmartPointer<vtkStructuredGrid> mapGrid(const Situation& situation)
{
  auto grid = shell::structuredGrid(situation);
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(grid->GetNumberOfPoints());
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    Vector3 at;
    grid->GetPoint(p, at.v);
    at = onMap(at);
    const bool west = p % situation.points[0] > situation.points[0] / 2 && at[0] < 0;
    points->SetPoint(p, at[0] + (west ? 2 * Pi : 0), at[1], at[2]);
  }
  grid->SetPoints(points);
  return grid;
}

/// The integral of what is linear in the cells' tetrahedra.
double massOf(vtkStructuredGrid* grid)
{
  int n[3];
  grid->GetDimensions(n);
  vtkDataArray* const fraction = grid->GetPointData()->GetArray(arrays::CloudFraction);
  double mass = 0;
  for (int k = 0; k < n[2] - 1; ++k)
  {
    for (int j = 0; j < n[1] - 1; ++j)
    {
      for (int i = 0; i < n[0] - 1; ++i)
      {
        for (const auto& t : TetrahedralSplit[static_cast<std::size_t>(splitParity(i, j, k))])
        {
          std::array<Vector3, 4> corners;
          std::array<double, 4> values{};
          for (std::size_t v = 0; v < 4; ++v)
          {
            int at[3] = { i + (t[v] & 1), j + (t[v] >> 1 & 1), k + (t[v] >> 2) };
            const vtkIdType p = vtkStructuredData::ComputePointId(n, at);
            grid->GetPoint(p, corners[v].v);
            values[v] = fraction->GetComponent(p, 0);
          }
          mass += linearMass(corners, values);
        }
      }
    }
  }
  return mass;
}

class ConversionJob : public Job
{
public:
  ConversionJob(const Situation& situation, int voxelsACell)
    : Grid(mapGrid(situation))
    , Size{ 2 * Pi / situation.points[0] / voxelsACell, Pi / situation.points[1] / voxelsACell,
      shell::Top / (situation.points[2] - 1) * 2 / voxelsACell }
  {
    std::string name = (std::filesystem::temp_directory_path() / "conversion-XXXXXX").string();
    if (!::mkdtemp(name.data()))
    {
      throw std::runtime_error("no folder can be made for " + name);
    }
    this->Folder = name;
  }
  ~ConversionJob() override
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Folder, ignored);
  }

  Figures figures() override
  {
    vtkNew<vtkCloudVDBReader> reader;
    reader->SetFileName(this->file().c_str());
    reader->Update();
    auto* const bricks = vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0));
    auto* const values =
      vtkFloatArray::SafeDownCast(bricks->GetPointData()->GetArray(arrays::VoxelBricks));
    auto* const origins =
      vtkIntArray::SafeDownCast(bricks->GetPointData()->GetArray(arrays::VoxelOrigins));
    std::map<std::array<int, 3>, const float*> found;
    for (vtkIdType b = 0; b < origins->GetNumberOfTuples(); ++b)
    {
      std::array<int, 3> origin{};
      origins->GetTypedTuple(b, origin.data());
      found[origin] = values->GetPointer(512 * b);
    }
    const double sum =
      std::accumulate(values->GetPointer(0), values->GetPointer(values->GetNumberOfValues()), 0.0);
    const double volume = this->Size[0] * this->Size[1] * this->Size[2];
    return { { "error", this->error(found) },
      { "massError", std::abs(sum * volume / massOf(this->Grid) - 1) },
      { "bricks", static_cast<double>(found.size()) },
      { "bytes", static_cast<double>(std::filesystem::file_size(this->file())) } };
  }

protected:
  std::string file() const { return (this->Folder / "cloud.vdb").string(); }

  void write(vtkDataObject* data, const char* name) const
  {
    vtkNew<vtkCloudVDBWriter> writer;
    writer->SetInputData(data);
    writer->SetFileName(this->file().c_str());
    writer->SetVoxelSize(this->Size.v);
    writer->SetFullCoverExtinction(1);
    writer->AddGridName(name);
    if (!writer->Write())
    {
      throw std::runtime_error("the voxels cannot be written");
    }
  }

  vtkSmartPointer<vtkStructuredGrid> Grid;
  Vector3 Size;

private:
  using Bricks = std::map<std::array<int, 3>, const float*>;

  static float valueOf(const Bricks& bricks, const std::array<int, 3>& voxel)
  {
    std::array<int, 3> origin{};
    int place = 0;
    for (std::size_t c = 3; c-- > 0;)
    {
      origin[c] = voxel[c] & ~7;
      place = 8 * place + (voxel[c] & 7);
    }
    const auto brick = bricks.find(origin);
    return brick == bricks.end() ? 0 : brick->second[place];
  }

  double meanOver(const std::array<int, 3>& voxel) const
  {
    constexpr int Samples = 6;
    double sum = 0;
    for (int n = 0; n < Samples * Samples * Samples; ++n)
    {
      const int at[3] = { n % Samples, n / Samples % Samples, n / Samples / Samples };
      Vector3 map;
      for (int c = 0; c < 3; ++c)
      {
        map[c] =
          this->Size[c] * (voxel[static_cast<std::size_t>(c)] + (at[c] + 0.5) / Samples - 0.5);
      }
      sum += fractionAt(map);
    }
    return sum / (Samples * Samples * Samples);
  }

  /// Over voxels here and there, away from the map's edges.
  double error(const Bricks& bricks) const
  {
    double squares = 0;
    double wrong = 0;
    for (int n = 1; n <= 4000; ++n)
    {
      // Weyl's sequence: no two coordinates in step.
      const auto share = [n](double step) { return n * step - std::floor(n * step); };
      const double place[3] = { 0.1 + 6 * share(std::sqrt(2)), -1.4 + 2.8 * share(std::sqrt(3)),
        1.25 * shell::Top * share(std::sqrt(5)) };
      std::array<int, 3> voxel{};
      for (std::size_t c = 0; c < 3; ++c)
      {
        voxel[c] = static_cast<int>(std::lround(place[c] / this->Size[static_cast<int>(c)]));
      }
      const double truth = this->meanOver(voxel);
      const double value = static_cast<double>(valueOf(bricks, voxel));
      squares += truth * truth;
      wrong += (value - truth) * (value - truth);
    }
    return std::sqrt(wrong / squares);
  }

  std::filesystem::path Folder;
};

class OwnConversion : public ConversionJob
{
public:
  using ConversionJob::ConversionJob;
  void run() override { this->write(this->Grid, "density"); }
};

class Resampled : public ConversionJob
{
public:
  using ConversionJob::ConversionJob;

  void run() override
  {
    vtkNew<vtkResampleToImage> resample;
    resample->SetInputDataObject(this->Grid);
    resample->UseInputBoundsOff();
    double bounds[6];
    this->Grid->GetBounds(bounds);
    int points[3];
    for (int c = 0; c < 3; ++c) // at the same centres
    {
      const double low = std::floor(bounds[2 * c] / this->Size[c]);
      const double high = std::ceil(bounds[2 * c + 1] / this->Size[c]);
      points[c] = static_cast<int>(high - low) + 1;
      bounds[2 * c] = low * this->Size[c];
      bounds[2 * c + 1] = high * this->Size[c];
    }
    resample->SetSamplingBounds(bounds);
    resample->SetSamplingDimensions(points);
    resample->Update();
    // Voxels are numbered from the origin of the map.
    vtkNew<vtkImageData> image;
    image->ShallowCopy(resample->GetOutput());
    int extent[6];
    double origin[3] = { 0, 0, 0 };
    for (int c = 0; c < 3; ++c)
    {
      extent[2 * c] = static_cast<int>(std::lround(bounds[2 * c] / this->Size[c]));
      extent[2 * c + 1] = extent[2 * c] + points[c] - 1;
    }
    image->SetExtent(extent);
    image->SetOrigin(origin);
    this->write(image, arrays::CloudFraction);
  }
};

template <class Job>
Registration conversion(const char* name, bool ours, int voxelsACell)
{
  return Registration(
    { name, "conversion", { { "voxels a cell", std::to_string(voxelsACell) } }, ours, false, 0,
      [voxelsACell](const Situation& s) { return std::make_unique<Job>(s, voxelsACell); } });
}

const Registration own1 = conversion<OwnConversion>("vtkCloudVDBWriter", true, 1);
const Registration own2 = conversion<OwnConversion>("vtkCloudVDBWriter", true, 2);
const Registration own4 = conversion<OwnConversion>("vtkCloudVDBWriter", true, 4);
const Registration peer1 = conversion<Resampled>("vtkResampleToImage", false, 1);
const Registration peer2 = conversion<Resampled>("vtkResampleToImage", false, 2);
const Registration peer4 = conversion<Resampled>("vtkResampleToImage", false, 4);
}
}
}
