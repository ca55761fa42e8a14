// SPDX-License-Identifier: BSD-3-Clause
#ifndef ErrorText_h
#define ErrorText_h

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"

#include <string>

/// Updates an algorithm and returns what it, but not its input, reports as errors and warnings.
inline std::string errorTextOf(vtkAlgorithm* algorithm)
{
  std::string text;
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&text);
  note->SetCallback([](vtkObject*, unsigned long, void* client, void* data)
    { *static_cast<std::string*>(client) += static_cast<const char*>(data); });
  const unsigned long error = algorithm->AddObserver(vtkCommand::ErrorEvent, note);
  const unsigned long warning = algorithm->AddObserver(vtkCommand::WarningEvent, note);
  const unsigned long executive =
    algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, note);
  algorithm->Update();
  algorithm->RemoveObserver(error);
  algorithm->RemoveObserver(warning);
  algorithm->GetExecutive()->RemoveObserver(executive);
  return text;
}

/// The same of an algorithm whose input fails, and does not print what that says.
inline std::string inputErrorOf(vtkAlgorithm* algorithm, vtkAlgorithm* input)
{
  vtkNew<vtkCallbackCommand> silent;
  silent->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  const unsigned long of = input->AddObserver(vtkCommand::ErrorEvent, silent);
  const unsigned long ofExecutive =
    input->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silent);
  std::string text = errorTextOf(algorithm);
  input->RemoveObserver(of);
  input->GetExecutive()->RemoveObserver(ofExecutive);
  return text;
}
#endif
