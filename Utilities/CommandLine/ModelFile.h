// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ModelFile.h
 * @brief A model's file, opened as a scene's data section says.
 */
#ifndef ModelFile_h
#define ModelFile_h

#include "Scene.h"

#include <vtkSmartPointer.h>

class vtkCloudNetCDFReader;
class vtkStructuredGrid;

namespace nephoscope::program
{
/// A reader that knows what is in the file; no field is read yet. @throw Failure if the file cannot be understood
vtkSmartPointer<vtkCloudNetCDFReader> openModelFile(const Data& data);

/**
 * The step that a text means: an ISO 8601 date (or its beginning, if that is enough), else a number of seconds on the
 * file's time axis that is exactly a step, else an index from 0. No text is the first step.
 * @throw Failure if there is no such step
 */
int timeStepOf(vtkCloudNetCDFReader* reader, const std::optional<std::string>& time);

/**
 * The time, in seconds on the file's axis, that a text means: as for timeStepOf, or any date or number of seconds between the first
 * and the last step. No text is the first step.
 * @throw Failure if the file's times do not reach there
 */
double timeOf(vtkCloudNetCDFReader* reader, const std::optional<std::string>& time);

/**
 * Read the fields of a step. Says on standard error which time it took if there are several, and which warnings there were.
 * @param needsFraction diagnose a cloud fraction where the file has only condensate, and say so
 */
vtkSmartPointer<vtkStructuredGrid> readStep(
  vtkCloudNetCDFReader* reader, const std::optional<std::string>& time, bool needsFraction);
}
#endif
