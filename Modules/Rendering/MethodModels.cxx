// SPDX-License-Identifier: BSD-3-Clause
#include "SceneParts.h"

namespace nephoscope
{
const std::vector<MethodModel>& methodModels()
{
  // Name; work; seconds for one of each; scale and power of the error. Constants for a machine with two slow cores.
  static const std::vector<MethodModel> models{
    { "nothing", {}, {}, 0, 0 },
    { "picture", { "start", "rays" }, { 1e-3, 1e-7 }, 0, 0 },
    { "ground", { "rays" }, { 1e-6 }, 0, 0 },
    { "terrain", { "rays" }, { 5e-6 }, 0, 0 },
    { "water", { "rays" }, { 5e-6 }, 0, 0 },
    { "uniform haze", { "rays" }, { 2e-7 }, 0, 0 },
    { "surface", { "triangles", "rays" }, { 1e-6, 1e-6 }, 0, 0 },
    { "texture", { "triangles", "rays", "rays times terms" }, { 1e-6, 1e-6, 1e-7 }, 0, 0 },
    { "shadow", { "points" }, { 3e-7 }, 0, 0 },
    { "height field Moments", { "rays", "samples of slices" }, { 4e-6, 1e-8 }, 2, 1 },
    { "height field Moments shared", { "rays", "samples of slices" }, { 4e-6, 1e-8 }, 3, 1 },
    { "height field Sexp1986", { "rays", "samples of slices" }, { 4e-6, 1e-8 }, 1, 0 },
    { "height field March", { "rays", "steps" }, { 2e-6, 2e-7 }, 3, 1 },
    { "height field Exact", { "rays", "waves along rays" }, { 1e-4, 1e-4 }, 1e-5, 0 },
    { "haze Moments", { "points of the shadow", "samples of the table", "rays" },
      { 1e-7, 1e-7, 1e-6 }, 0.1, 1 },
    { "haze March", { "points of the shadow", "rays", "steps" }, { 1e-7, 1e-6, 2e-7 }, 0.1, 1 },
    { "haze March without clouds", { "rays", "steps" }, { 1e-6, 1e-7 }, 1, 2 },
    { "haze Exact", { "points of the shadow", "grid lines along rays", "rays" },
      { 1e-7, 1e-7, 1e-6 }, 1e-5, 0 },
    { "haze without clouds", { "rays" }, { 5e-6 }, 1e-3, 0 },
    { "cells PixelDepth", { "points", "segments" }, { 2e-7, 1e-7 }, 3e-5, 0 },
    { "cells summed", { "points", "segments" }, { 2e-7, 5e-8 }, 3e-5, 0 },
    { "cells Visibility", { "points", "segments" }, { 1e-5, 2e-7 }, 1, 0, false },
    { "cells Centroid", { "points", "segments" }, { 5e-6, 2e-7 }, 1, 0, false },
  };
  return models;
}
}
