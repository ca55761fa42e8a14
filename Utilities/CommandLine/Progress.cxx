// SPDX-License-Identifier: BSD-3-Clause
#include "Progress.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkObject.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <unistd.h>

namespace nephoscope::program
{
namespace
{
/// Passes progress events on to a function.
class Listener : public vtkCommand
{
public:
  static Listener* New() { return new Listener; }
  vtkTypeMacro(Listener, vtkCommand);

  void Execute(vtkObject*, unsigned long, void* done) override
  {
    this->Show(done ? *static_cast<double*>(done) : 0);
  }

  std::function<void(double)> Show;
};
}

Progress::Progress()
  : Terminal(::isatty(STDERR_FILENO) != 0)
{
}

Progress::~Progress()
{
  this->forget();
}

void Progress::forget()
{
  for (const Watched& watched : this->All)
  {
    watched.Working->RemoveObserver(watched.Tag);
  }
  this->All.clear();
  if (this->Shown)
  {
    std::fputs("\r\033[K", stderr);
    this->Shown = false;
  }
}

void Progress::watch(vtkObject* working, const std::string& name)
{
  if (!this->Terminal)
  {
    return;
  }
  const vtkNew<Listener> listener;
  listener->Show = [this, name](double done) { this->show(name, done); };
  this->All.push_back({ working, working->AddObserver(vtkCommand::ProgressEvent, listener) });
}

void Progress::show(const std::string& name, double done)
{
  const auto now = std::chrono::steady_clock::now();
  if (!this->Terminal || (this->Shown && now - this->Last < std::chrono::milliseconds(100)))
  {
    return;
  }
  this->Last = now;
  this->Shown = true;
  constexpr int width = 40;
  const int filled = static_cast<int>(width * std::clamp(done, 0.0, 1.0));
  const std::string bar = std::string(filled, '#') + std::string(width - filled, ' ');
  std::fprintf(stderr, "\r\033[K%-10s [%s] %3d %%", name.c_str(), bar.c_str(),
    static_cast<int>(100 * std::clamp(done, 0.0, 1.0)));
  std::fflush(stderr);
}

double Stopwatch::lap()
{
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - this->Started).count();
  this->Started = now;
  return seconds;
}
}
