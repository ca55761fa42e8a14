// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file RankTesting.h
 * @brief Tests that several processes run together, started by mpirun: who is who, errors that are awaited, and main.
 */
#ifndef RankTesting_h
#define RankTesting_h

#include "vtkCallbackCommand.h"
#include "vtkCommunicator.h"
#include "vtkMPIController.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <iostream>
#include <string>

inline vtkMultiProcessController* controller()
{
  return vtkMultiProcessController::GetGlobalController();
}
inline int rank()
{
  return controller()->GetLocalProcessId();
}
inline int ranks()
{
  return controller()->GetNumberOfProcesses();
}

/// Whether something holds in all processes; all of them ask.
inline bool everywhere(bool here)
{
  const int mine = here ? 1 : 0;
  int all = 0;
  controller()->AllReduce(&mine, &all, 1, vtkCommunicator::MIN_OP);
  return all == 1;
}

/// Remembers that there was an error, and does not print it.
struct Errors
{
  explicit Errors(vtkObject* of)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* text)
      { static_cast<Errors*>(self)->Text += static_cast<const char*>(text); });
    of->AddObserver("ErrorEvent", this->Command);
  }
  vtkNew<vtkCallbackCommand> Command;
  std::string Text;
};

/// What processes but the first say: their failures.
class FailurePrinter : public testing::EmptyTestEventListener
{
  void OnTestPartResult(const testing::TestPartResult& result) override
  {
    if (result.failed())
    {
      std::cerr << "process " << rank() << ": " << result.file_name() << ':' << result.line_number()
                << ": " << result.message() << std::endl;
    }
  }
};

/// Run all tests in all processes; fails if one does in one of them.
inline int runRankedTests(int argc, char* argv[])
{
  vtkNew<vtkMPIController> world;
  world->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(world);
  testing::InitGoogleTest(&argc, argv);
  if (world->GetLocalProcessId() > 0)
  {
    testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FailurePrinter);
  }
  const bool passed = everywhere(RUN_ALL_TESTS() == 0);
  vtkMultiProcessController::SetGlobalController(nullptr);
  world->Finalize();
  return passed ? 0 : 1;
}
#endif
