// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HeightFieldInput.h
 * @brief The height field of a filter's input, from the field data array that vtkCloudHeightFieldSource writes.
 */
#ifndef HeightFieldInput_h
#define HeightFieldInput_h

#include "CloudArrays.h"
#include "Cumulus.h"
#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"

/// False, with an error of the filter, if the first input has none.
inline bool readHeightField(vtkAlgorithm* filter, vtkInformationVector** inputs,
  nephoscope::HeightFieldShape& shape, double& plane)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputs[0]);
  auto* const numbers = vtkDoubleArray::SafeDownCast(
    input->GetFieldData()->GetAbstractArray(nephoscope::arrays::HeightField));
  if (numbers &&
    nephoscope::shapeOf(
      numbers->GetPointer(0), static_cast<std::size_t>(numbers->GetNumberOfValues()), shape, plane))
  {
    return true;
  }
  vtkErrorWithObjectMacro(filter,
    "The input has no field data array "
      << nephoscope::arrays::HeightField
      << " of a height field; connect a vtkCloudHeightFieldSource.");
  return false;
}
#endif
