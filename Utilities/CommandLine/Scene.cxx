// SPDX-License-Identifier: BSD-3-Clause
#include "Scene.h"

#include "Failure.h"

namespace nephoscope::program
{
namespace
{
template <class Type, class Variant>
bool holds(const std::vector<Variant>& parts)
{
  for (const Variant& part : parts)
  {
    if (std::holds_alternative<Type>(part))
    {
      return true;
    }
  }
  return false;
}
}

Scene sceneOfStyle(const std::string& style, const std::string& dataFile)
{
  Scene scene;
  scene.data.file = dataFile;
  if (style == "surface")
  {
    scene.bodies.emplace_back(SurfaceBody());
  }
  else if (style == "texture")
  {
    scene.bodies.emplace_back(TextureBody());
  }
  else if (style == "volume")
  {
    scene.bodies.emplace_back(VolumeBody());
  }
  else
  {
    throw UsageFailure("there is no style '" + style + "'; it can be surface, texture or volume");
  }
  return scene;
}

void validate(const Scene& scene, const std::string& name)
{
  const bool cloudy = holds<SurfaceBody>(scene.bodies) || holds<TextureBody>(scene.bodies) ||
    holds<VolumeBody>(scene.bodies);
  if (cloudy && scene.data.file.empty())
  {
    throw UsageFailure(name + ": the bodies need data; add data: { file: NAME.nc }");
  }
  if (scene.bodies.empty())
  {
    throw UsageFailure(name + ": there is nothing to draw; add bodies: [{ type: volume }]");
  }
}
}
