// SPDX-License-Identifier: BSD-3-Clause
#include "InputPipeline.h"

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"

namespace nephoscope
{
vtkStandardNewMacro(InputPipeline);

int InputPipeline::ForwardUpstream(vtkInformation* request)
{
  const int result = this->Superclass::ForwardUpstream(request);
  if (!request->Has(REQUEST_DATA()))
  {
    return result;
  }
  this->InputCame = result != 0;
  return 1;
}

const char* whatInputLacks(vtkAlgorithm* filter)
{
  auto* const pipeline = InputPipeline::SafeDownCast(filter->GetExecutive());
  return pipeline && !pipeline->HasInput() ? "The input has failed; see its message." : "";
}
}
