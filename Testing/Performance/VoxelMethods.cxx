// SPDX-License-Identifier: BSD-3-Clause
// A cubic cloud of voxels in sunlight scattered once: vtkCloudVoxelVolume against OpenVDB's vdb_render, the same file, camera, light and
// extinction (vdb_render's coefficients are per voxel; a voxel here measures 1). A run reads the file, finds the shadows and draws the
// picture; vdb_render's has the start of its process too. Figures: error, the RMS of radiance over 1/16 of the pixels each way against
// steps of a quarter voxel with exact shadows; vdb_render's 8 bits are an error of 1e-3.
#include "Benchmark.h"
#include "CloudArrays.h"
#include "VoxelTree.h"

#include "vtkCamera.h"
#include "vtkCloudVDBReader.h"
#include "vtkCloudVDBWriter.h"
#include "vtkCloudVoxelVolume.h"
#include "vtkCloudscape.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <Camera.h>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

namespace nephoscope
{
namespace performance
{
namespace
{
constexpr double Extinction = 0.3; // 1/voxel
constexpr double AngleAcross = 40; // degrees
constexpr double Pi = 3.14159265358979323846;
const Vector3 TowardSun = normalized(Vector3{ 0.5, -0.3, 0.8 });

Vector3 middleOf(const Situation& s)
{
  return { 0.5 * s.points[0], 0.5 * s.points[1], 0.5 * s.points[2] };
}
Vector3 eyeOf(const Situation& s)
{
  return middleOf(s) + (1.0 * s.points[0]) * Vector3{ -0.3, -1.45, 0.4 };
}

/// A ball with a billowing outline, density 0 to 1.
vtkSmartPointer<vtkImageData> cloud(const Situation& s)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(s.points.data());
  vtkNew<vtkFloatArray> density;
  density->SetName(arrays::Extinction);
  density->SetNumberOfTuples(image->GetNumberOfPoints());
  vtkIdType point = 0;
  const double scale = 2.0 / s.points[0];
  for (int k = 0; k < s.points[2]; ++k)
  {
    for (int j = 0; j < s.points[1]; ++j)
    {
      for (int i = 0; i < s.points[0]; ++i)
      {
        const double x = scale * i - 1;
        const double y = scale * j - 1;
        const double z = scale * k - 1;
        double billow = 0;
        double frequency = 4;
        for (int octave = 0; octave < 4; ++octave, frequency *= 1.9)
        {
          billow += std::sin(frequency * x + octave) * std::sin(1.1 * frequency * y - octave) *
            std::sin(0.9 * frequency * z + 2 * octave) / (octave + 1);
        }
        const double value = 3 * (0.62 - std::sqrt(x * x + y * y + 1.4 * z * z) + 0.25 * billow);
        density->SetValue(point++, static_cast<float>(std::min(1.0, std::max(0.0, value))));
      }
    }
  }
  image->GetPointData()->SetScalars(density);
  return image;
}

/// The cloud's file and what the methods' pictures of it are compared with.
class VoxelJob : public Job
{
public:
  explicit VoxelJob(const Situation& situation)
    : At(situation)
    , Folder(std::filesystem::temp_directory_path() /
        ("nephoscope-voxels-" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(this->Folder);
    vtkNew<vtkCloudVDBWriter> writer;
    writer->SetInputData(cloud(situation));
    writer->SetFileName(this->file().c_str());
    if (!writer->Write())
    {
      throw std::runtime_error("the cloud cannot be written");
    }
  }

  Figures figures() override
  {
    const VoxelTree tree = this->tree();
    const Camera camera = this->camera();
    double sum = 0;
    int compared = 0;
    for (int y = 8; y < this->At.pixels[1]; y += 16)
    {
      for (int x = 8; x < this->At.pixels[0]; x += 16)
      {
        const double truth = converged(tree, camera.ray(x + 0.5, y + 0.5));
        const double drawn = this->radiance(x, y);
        if (truth > 0 || drawn > 0)
        {
          sum += (drawn - truth) * (drawn - truth);
          ++compared;
        }
      }
    }
    std::filesystem::remove_all(this->Folder);
    return { { "error", std::sqrt(sum / std::max(compared, 1)) }, { "pixelsCompared", compared } };
  }

protected:
  std::string file() const { return (this->Folder / "cloud.vdb").string(); }
  /// Of the last run; y from below.
  virtual double radiance(int x, int y) = 0;

  Camera camera() const
  {
    return Camera::perspective(eyeOf(this->At), middleOf(this->At), { 0, 0, 1 }, this->angleUp(),
      this->At.pixels[0], this->At.pixels[1]);
  }
  double angleUp() const
  {
    return 360 / Pi *
      std::atan(std::tan(AngleAcross * Pi / 360) * this->At.pixels[1] / this->At.pixels[0]);
  }

  Situation At;
  std::filesystem::path Folder;

private:
  VoxelTree tree() const
  {
    vtkNew<vtkCloudVDBReader> reader;
    reader->SetFileName(this->file().c_str());
    reader->Update();
    auto* const bricks = vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0));
    auto* const origins =
      vtkIntArray::SafeDownCast(bricks->GetPointData()->GetArray(arrays::VoxelOrigins));
    auto* const values =
      vtkFloatArray::SafeDownCast(bricks->GetPointData()->GetArray(arrays::VoxelBricks));
    std::vector<std::array<int, 3>> places(static_cast<std::size_t>(origins->GetNumberOfTuples()));
    for (std::size_t b = 0; b < places.size(); ++b)
    {
      origins->GetTypedTuple(static_cast<vtkIdType>(b), places[b].data());
    }
    VoxelTree tree(places, values->GetPointer(0));
    tree.setSun(TowardSun);
    return tree;
  }

  static double converged(const VoxelTree& tree, const Ray& ray)
  {
    constexpr double Step = 0.25;
    double light = 0;
    double through = 1;
    tree.walk(ray.origin, ray.direction, 0, 1e6,
      [&](std::size_t brick, double near, double far)
      {
        const int steps = static_cast<int>(std::ceil((far - near) / Step));
        const double h = (far - near) / steps;
        for (int n = 0; n < steps; ++n)
        {
          const double t = near + n * h;
          const double depth =
            Extinction * tree.depthInBrick(brick, ray.origin, ray.direction, t, t + h);
          if (depth > 0)
          {
            const Vector3 middle = ray.origin + (t + 0.5 * h) * ray.direction;
            light +=
              through * -std::expm1(-depth) * std::exp(-Extinction * tree.sunDepthExact(middle));
            through *= std::exp(-depth);
          }
        }
        return through > 1e-5;
      });
    return light;
  }
};

class OwnVoxels : public VoxelJob
{
public:
  using VoxelJob::VoxelJob;

  void run() override
  {
    vtkNew<vtkCloudVDBReader> reader;
    reader->SetFileName(this->file().c_str());
    vtkNew<vtkCloudVoxelVolume> volume;
    volume->SetInputConnection(reader->GetOutputPort());
    volume->SetExtinctionScale(Extinction);
    volume->SetAmbient(0);
    volume->SetSunColor(1, 1, 1);
    volume->SetTowardSun(TowardSun[0], TowardSun[1], TowardSun[2]);
    vtkNew<vtkCamera> camera;
    const Vector3 eye = eyeOf(this->At);
    const Vector3 middle = middleOf(this->At);
    camera->SetPosition(eye[0], eye[1], eye[2]);
    camera->SetFocalPoint(middle[0], middle[1], middle[2]);
    camera->SetViewUp(0, 0, 1);
    camera->SetViewAngle(this->angleUp());
    vtkNew<vtkCloudscape> scape;
    scape->SetCamera(camera);
    scape->SetSize(this->At.pixels[0], this->At.pixels[1]);
    scape->SetComputeDepth(false);
    scape->AddBody(volume);
    scape->Update();
    this->Picture = scape->GetOutput();
  }

protected:
  double radiance(int x, int y) override
  {
    return this->Picture->GetPointData()
      ->GetArray(arrays::Radiance)
      ->GetComponent(static_cast<vtkIdType>(y) * this->At.pixels[0] + x, 0);
  }

private:
  vtkSmartPointer<vtkImageData> Picture;
};

class VdbRender : public VoxelJob
{
public:
  VdbRender(const Situation& situation, double step, double shadowStep)
    : VoxelJob(situation)
  {
    if (std::system("command -v vdb_render > /dev/null") != 0)
    {
      throw std::runtime_error("needs vdb_render; install libopenvdb-tools");
    }
    const Vector3 eye = eyeOf(situation);
    const Vector3 middle = middleOf(situation);
    std::ostringstream command;
    command.precision(12);
    command << "vdb_render '" << this->file() << "' '" << this->picture() << "' -res "
            << situation.pixels[0] << 'x' << situation.pixels[1] << " -cpus " << situation.threads
            << " -fov " << AngleAcross << " -translate " << eye[0] << ',' << eye[1] << ',' << eye[2]
            << " -lookat " << middle[0] << ',' << middle[1] << ',' << middle[2]
            << " -up 0,0,1 -absorb 0,0,0 -scatter " << Extinction << ',' << Extinction << ','
            << Extinction << " -gain 0 -light " << TowardSun[0] << ',' << TowardSun[1] << ','
            << TowardSun[2] << ",1,1,1 -step " << step << " -shadowstep " << shadowStep
            << " > /dev/null 2>&1";
    this->Command = command.str();
  }

  void run() override
  {
    if (std::system(this->Command.c_str()) != 0)
    {
      throw std::runtime_error("vdb_render failed");
    }
  }

protected:
  double radiance(int x, int y) override
  {
    if (this->Pixels.empty())
    {
      std::ifstream file(this->picture(), std::ios::binary);
      std::string kind;
      int width = 0;
      int height = 0;
      int most = 0;
      file >> kind >> width >> height >> most;
      file.get();
      this->Pixels.assign(std::istreambuf_iterator<char>(file), {});
      if (kind != "P6" || width != this->At.pixels[0] ||
        this->Pixels.size() <
          3U * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
      {
        throw std::runtime_error("vdb_render's picture cannot be read");
      }
    }
    const std::size_t row = static_cast<std::size_t>(this->At.pixels[1] - 1 - y);
    const std::size_t at =
      3 * (row * static_cast<std::size_t>(this->At.pixels[0]) + static_cast<std::size_t>(x));
    const int level = static_cast<unsigned char>(this->Pixels[at]);
    return level > 0 ? (level + 0.5) / 255 : 0; // it cuts off, and does not round
  }

private:
  std::string picture() const { return (this->Folder / "cloud.ppm").string(); }

  std::string Command;
  std::string Pixels;
};

Registration peer(double step, double shadowStep, const char* text)
{
  return Registration({ "vdb_render", "voxels", { { "steps", text } }, false, false, 0,
    [step, shadowStep](const Situation& s)
    { return std::make_unique<VdbRender>(s, step, shadowStep); } });
}

const Registration own({ "vtkCloudVoxelVolume", "voxels", {}, true, false, 0,
  [](const Situation& s) { return std::make_unique<OwnVoxels>(s); } });
const Registration usual = peer(1, 3, "1 and 3");
const Registration fine = peer(0.5, 1, "0.5 and 1");
}
}
}
