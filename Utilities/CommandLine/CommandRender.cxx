// SPDX-License-Identifier: BSD-3-Clause
// nephoscope render: a scene file, or a data file in a style, as a picture.
#include "Commands.h"
#include "Failure.h"
#include "Messages.h"
#include "OutputFile.h"
#include "PictureFile.h"
#include "Progress.h"
#include "Quality.h"
#include "SceneBuilder.h"
#include "SceneFile.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <vtkCloudscape.h>
#include <vtkImageData.h>
#include <vtkSMPTools.h>
#include <vtkVersion.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

namespace nephoscope::program
{
namespace
{
struct RenderOptions
{
  std::string scene;
  std::string style;
  Data data;
  std::string output;
  std::string stats;
  std::optional<std::string> size;
  std::optional<double> exposure;
  std::optional<double> value;
  std::optional<std::string> view;
  bool sceneKeys = false;
  bool explain = false;
  int verify = 0;
};

void setView(CameraView& camera, const std::string& text)
{
  double view[3] = { 0, 0, 0 };
  char extra = 0;
  const int given =
    std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &view[0], &view[1], &view[2], &extra);
  const bool commas = given == 1 + std::count(text.begin(), text.end(), ',');
  if (!commas || given < 2 || given > 3 || !(std::abs(view[0]) <= 360) ||
    !(std::abs(view[1]) <= 90) || (given == 3 && !(view[2] > 0 && view[2] <= 1e6)))
  {
    throw UsageFailure("--view " + text +
      " is not A,B or A,B,DISTANCE: a longitude or bearing, a latitude or elevation "
      "from -90 to 90 degrees, and a distance over 0, such as -35,20,4");
  }
  // Both pairs: the one that the scene's geometry has is used.
  camera.longitude = view[0];
  camera.latitude = view[1];
  camera.bearing = view[0];
  camera.elevation = view[1];
  if (given == 3)
  {
    camera.distance = view[2];
  }
}

/// Options that would change nothing are a mistake.
void refuseIdle(const Scene& scene, const RenderOptions& options)
{
  const Data& given = options.data;
  if (scene.data.file.empty() &&
    (given.time || given.exaggeration || !given.geometry.empty() || !given.variables.empty()))
  {
    throw UsageFailure("--time, --geometry, --exaggeration and --variable are of data, and " +
      options.scene + " has none");
  }
  const auto isSurface = [](const Body& body) {
    return std::holds_alternative<SurfaceBody>(body) || std::holds_alternative<TextureBody>(body);
  };
  if (options.value && std::none_of(scene.bodies.begin(), scene.bodies.end(), isSurface))
  {
    throw UsageFailure("--value is of surfaces and textures, and there are none in the scene");
  }
}

/// What the command line says wins over the scene file.
void override(Scene& scene, const RenderOptions& options)
{
  refuseIdle(scene, options);
  const Data& given = options.data;
  scene.data.time = given.time ? given.time : scene.data.time;
  scene.data.exaggeration = given.exaggeration ? given.exaggeration : scene.data.exaggeration;
  scene.data.geometry = given.geometry.empty() ? scene.data.geometry : given.geometry;
  for (const auto& [role, name] : given.variables)
  {
    scene.data.variables[role] = name;
  }
  if (options.size)
  {
    scene.picture.size = sizeOf(*options.size);
  }
  scene.picture.exposure = options.exposure.value_or(scene.picture.exposure);
  if (options.view)
  {
    setView(scene.camera, *options.view);
  }
  for (Body& body : scene.bodies)
  {
    SurfaceBody* surface = std::get_if<SurfaceBody>(&body);
    if (auto* const texture = std::get_if<TextureBody>(&body))
    {
      surface = texture;
    }
    if (surface)
    {
      surface->value = options.value.value_or(surface->value);
    }
  }
}

Scene sceneOf(const RenderOptions& options)
{
  const bool fromFile = !options.scene.empty();
  if (fromFile == !options.data.file.empty())
  {
    throw UsageFailure("give either a scene file or --data FILE; see nephoscope render --help");
  }
  if (fromFile == !options.style.empty())
  {
    throw UsageFailure(fromFile ? "--style goes with --data; a scene file names its bodies itself"
                                : "--data needs --style surface, texture or volume");
  }
  Scene scene =
    fromFile ? readScene(options.scene) : sceneOfStyle(options.style, options.data.file);
  override(scene, options);
  return scene;
}

nlohmann::ordered_json statsOf(const BuiltScene& built, double writeSeconds)
{
  vtkCloudscape* const scape = built.scape;
  return { { "seconds",
             { { "read", built.readSeconds }, { "filter", built.filterSeconds },
               { "prepare", scape->GetPipelineSeconds() + scape->GetPrepareSeconds() },
               { "tiles", scape->GetTileSeconds() }, { "write", writeSeconds } } },
    { "cells", built.cells }, { "triangles", built.triangles },
    { "segments", scape->GetNumberOfSegments() },
    { "threads", vtkSMPTools::GetEstimatedNumberOfThreads() },
    { "size", { scape->GetSize()[0], scape->GetSize()[1] } },
    { "versions",
      { { "nephoscope", NEPHOSCOPE_VERSION }, { "VTK", vtkVersion::GetVTKVersion() },
        { "smp", vtkSMPTools::GetBackend() } } } };
}

void runRender(const RenderOptions& options)
{
  if (options.sceneKeys)
  {
    std::cout << sceneReference();
    return;
  }
  if (options.output.empty())
  {
    throw UsageFailure("render needs -o OUT.png or -o OUT.exr; see nephoscope render --help");
  }
  const std::string kind = extensionOf(options.output);
  if (kind != "png" && kind != "exr")
  {
    throw UsageFailure(options.output + ": the name must end in .png or .exr");
  }
  const Scene scene = sceneOf(options);
  if (options.explain && !scene.quality.isAsked())
  {
    throw UsageFailure("--explain tells how methods were chosen, which they are if the scene has "
                       "quality: { tolerance: 0.01 }");
  }
  checkWritable(options.output, { options.scene, scene.data.file });
  if (!options.stats.empty())
  {
    checkWritable(options.stats, { options.output, options.scene, scene.data.file });
  }
  Progress progress;
  const BuiltScene built = buildScene(scene, !options.style.empty(), progress);
  built.scape->SetComputeDepth(kind == "exr"); // a PNG has none
  const std::string explanation = chooseMethods(scene.quality, built.scape);
  std::cout << (options.explain ? explanation : "");
  progress.watch(built.scape, "draw");
  built.scape->Update();
  progress.forget();
  Messages::throwIfError(scene.subject());
  Messages::printWarnings();
  Stopwatch clock;
  writePicture(built.scape, scene.picture.exposure, options.output);
  if (!options.stats.empty())
  {
    writeText(options.stats, statsOf(built, clock.lap()).dump(2) + "\n");
  }
  if (options.verify > 0)
  {
    std::cout << verified(scene.quality, built.scape, options.verify, progress);
  }
}

void addPictureOptions(CLI::App& command, RenderOptions& options)
{
  command.add_option("--size", options.size, "width and height, pixels; default 1024x768")
    ->type_name("WxH");
  command
    .add_option(
      "--exposure", options.exposure, "stops; each doubles the brightness of a PNG; default 0")
    ->type_name("STOPS")
    ->check(numberFrom(-30, 30));
  command
    .add_option("--view", options.view,
      "globe: longitude and latitude under the eye, degrees, and distance from the centre, planet "
      "radii; "
      "map, local: bearing of the eye from the data and elevation, degrees, and distance, 1 where "
      "all fits")
    ->type_name("A,B[,DISTANCE]");
}
}

void addRender(CLI::App& app)
{
  auto options = std::make_shared<RenderOptions>();
  options->data.geometry.clear();
  CLI::App* const command = app.add_subcommand(
    "render", "Draw a scene, or the clouds of a NetCDF file in a style, as a picture.");
  command->add_option("scene", options->scene, "scene file (YAML)")->type_name("SCENE.yaml");
  command->add_option("--data", options->data.file, "NetCDF file, instead of a scene file")
    ->type_name("FILE");
  command
    ->add_option("--style", options->style,
      "surface: smooth contour of the cloud fraction; texture: the same with a transparency "
      "texture; "
      "volume: the grid's cells as glowing fog")
    ->type_name("surface|texture|volume")
    ->check(CLI::IsMember({ "surface", "texture", "volume" }).description(""));
  command
    ->add_option("-o,--output", options->output, "picture: PNG (sRGB) or OpenEXR (linear radiance)")
    ->type_name("OUT.{png,exr}");
  command
    ->add_option("--value", options->value, "cloud fraction of the surfaces, 0 to 1; default 0.15")
    ->type_name("V")
    ->check(numberFrom(0, 1));
  addPictureOptions(*command, *options);
  addDataOptions(*command, options->data);
  command->add_option("--stats", options->stats, "write seconds per stage and counts as JSON")
    ->type_name("FILE.json");
  command->add_flag("--explain", options->explain,
    "say which methods were chosen for the scene's quality, why, and what was left out");
  command
    ->add_option("--verify", options->verify,
      "after drawing, work N random pixels out by exact methods and say how wrong the picture is")
    ->type_name("N")
    ->check(CLI::Range(1, 1000000));
  addThreadsOption(*command);
  command->add_flag("--scene-keys", options->sceneKeys, "print every key of a scene file and end");
  command->footer(
    "Examples:\n"
    "  nephoscope render --data climate.nc --style texture -o clouds.png --size 1920x1080\n"
    "  nephoscope render --data climate.nc --style volume -o clouds.exr --view -30,20,4\n"
    "  nephoscope render Examples/Scenes/volume.yaml -o volume.png --stats volume.json");
  command->callback([options] { runRender(*options); });
}
}
