// SPDX-License-Identifier: BSD-3-Clause
// One picture by the processes of mpirun, one thread each. Prints the seconds and the memory that it took, for scaling.py:
//   RankScaling FILE WIDTH HEIGHT     fog and a contour surface round the globe, drawn three times; the fastest counts
#include "vtkCloudCellVolume.h"
#include "vtkCloudContour.h"
#include "vtkCloudNetCDFReader.h"
#include "vtkCloudSurface.h"
#include "vtkCloudscape.h"

#include "vtkCamera.h"
#include "vtkCommunicator.h"
#include "vtkMPIController.h"
#include "vtkNew.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

namespace
{
/// The most memory that this process has had, MB.
double peakMemory()
{
  std::ifstream status("/proc/self/status");
  std::string word;
  double kilobytes = 0;
  while (status >> word)
  {
    if (word == "VmHWM:")
    {
      status >> kilobytes;
    }
  }
  return kilobytes / 1024;
}

void look(vtkCloudscape* scape, int width, int height)
{
  vtkNew<vtkCamera> camera;
  camera->SetPosition(1.9e7, -1.2e7, 1.4e7);
  camera->SetFocalPoint(0, 0, 0);
  camera->SetViewUp(0, 0, 1);
  scape->SetCamera(camera);
  scape->SetSize(width, height);
}

/// Seconds of reading and contouring, of the picture, and MB: the most of all processes; MB that they sent one another.
std::array<double, 4> drawn(
  vtkMultiProcessController* world, const char* file, int width, int height)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(file);
  reader->SetVerticalExaggeration(40);
  vtkNew<vtkCloudContour> contour;
  contour->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkCloudSurface> surface;
  surface->SetInputConnection(contour->GetOutputPort());
  surface->SetOpacity(0.5);
  vtkNew<vtkCloudCellVolume> volume;
  volume->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkCloudscape> scape;
  scape->SetController(world);
  scape->AddBody(surface);
  scape->AddBody(volume);
  look(scape, width, height);
  world->Barrier();
  const auto start = std::chrono::steady_clock::now();
  scape->Update();
  world->Barrier();
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
  const std::array<double, 4> own{ scape->GetPipelineSeconds(),
    whole.count() - scape->GetPipelineSeconds(), peakMemory(),
    static_cast<double>(scape->GetBytesSent()) / 1e6 };
  std::array<double, 4> most{};
  world->AllReduce(own.data(), most.data(), 4, vtkCommunicator::MAX_OP);
  return most;
}
}

int main(int argc, char* argv[])
{
  vtkNew<vtkMPIController> world;
  world->Initialize(&argc, &argv);
  vtkSMPTools::Initialize(1);
  if (argc != 4)
  {
    std::cerr << "RankScaling FILE WIDTH HEIGHT\n";
    world->Finalize();
    return 1;
  }
  std::array<double, 4> best{ 1e30, 1e30, 0, 0 };
  for (int time = 0; time < 3; ++time)
  {
    const auto now = drawn(world, argv[1], std::atoi(argv[2]), std::atoi(argv[3]));
    best = { std::min(best[0], now[0]), std::min(best[1], now[1]), std::max(best[2], now[2]),
      now[3] };
  }
  if (world->GetLocalProcessId() == 0)
  {
    std::cout << best[0] << ' ' << best[1] << ' ' << best[2] << ' ' << best[3] << std::endl;
  }
  world->Finalize();
  return 0;
}
