// SPDX-License-Identifier: BSD-3-Clause
#include "Scene.h"

#include "Failure.h"

#include <algorithm>

namespace nephoscope::program
{
namespace
{
void requireDirection(const std::optional<Triple>& direction, const std::string& what)
{
  if (direction && *direction == Triple{ 0, 0, 0 })
  {
    throw UsageFailure(what + " is [0, 0, 0], which is no direction; give another");
  }
}

void requireView(const Scene& scene, const std::string& name)
{
  if (!scene.camera.position || !scene.camera.target)
  {
    throw UsageFailure(name +
      ": a scene without data has no middle to look at; give camera: { position: [X, Y, Z], "
      "target: [X, Y, Z] }");
  }
}
}

bool needsData(const Body& body)
{
  return !std::holds_alternative<PlaneBody>(body) && !std::holds_alternative<TerrainBody>(body) &&
    !std::holds_alternative<WaterBody>(body) && !std::holds_alternative<HeightFieldBody>(body) &&
    !std::holds_alternative<VoxelBody>(body);
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
  for (std::size_t n = 1; n < scene.keyframes.size(); ++n)
  {
    if (!(scene.keyframes[n].at > scene.keyframes[n - 1].at))
    {
      throw UsageFailure(name + ": the 'at' of keyframe " + std::to_string(n + 1) +
        " is not greater than that of the one before; put them in order");
    }
  }
  if (scene.quality.tolerance && scene.quality.seconds)
  {
    throw UsageFailure(name + ": quality: asks for a tolerance and for seconds; give one of both");
  }
  if (scene.bodies.empty())
  {
    throw UsageFailure(name + ": there is nothing to draw; add bodies: [{ type: volume }]");
  }
  for (const Body& body : scene.bodies)
  {
    const auto* const voxels = std::get_if<VoxelBody>(&body);
    if (voxels && voxels->file.empty())
    {
      throw UsageFailure(
        name + ": a 'voxelVolume' has no 'file'; give one, such as file: cloud.vdb");
    }
  }
  if (scene.data.file.empty())
  {
    if (std::any_of(scene.bodies.begin(), scene.bodies.end(), needsData))
    {
      throw UsageFailure(name + ": the bodies need data; add data: { file: NAME.nc }");
    }
    requireView(scene, name);
  }
  requireDirection(scene.camera.up, name + ": camera: 'up'");
  requireDirection(scene.light.towardSun, name + ": light: 'towardSun'");
  for (const Keyframe& frame : scene.keyframes)
  {
    requireDirection(frame.towardSun, name + ": keyframes: 'towardSun'");
  }
}
}
