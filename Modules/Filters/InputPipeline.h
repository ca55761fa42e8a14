// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file InputPipeline.h
 * @brief The executive of filters that ask for several times: it calls them also when their input has failed.
 *
 * The usual one does not call a filter then. A filter that goes on executing would be asked for its next time for ever, and other processes
 * would wait for one that was not called. In programs that give filters executives of their own, as ParaView does, that still holds.
 */
#ifndef InputPipeline_h
#define InputPipeline_h

#include "vtkCompositeDataPipeline.h"

class vtkAlgorithm;

namespace nephoscope
{
class InputPipeline : public vtkCompositeDataPipeline
{
public:
  static InputPipeline* New();
  vtkTypeMacro(InputPipeline, vtkCompositeDataPipeline);

  /// Whether the last data that were asked for have come; for RequestData.
  bool HasInput() const { return this->InputCame; }

protected:
  using Superclass::ForwardUpstream;
  int ForwardUpstream(vtkInformation* request) override;

private:
  bool InputCame = true;
};

/// What a filter's RequestData has to say if its input has failed, otherwise empty.
const char* whatInputLacks(vtkAlgorithm* filter);
}
#endif
