// SPDX-License-Identifier: BSD-3-Clause
#include "SceneParts.h"

#include "Camera.h"
#include "CloudArrays.h"
#include "CloudTexture.h"
#include "Cumulus.h"
#include "MethodChoice.h"
#include "RadianceError.h"
#include "SceneRays.h"
#include "vtkCloudCellVolume.h"
#include "vtkCloudGround.h"
#include "vtkCloudHaze.h"
#include "vtkCloudHeightField.h"
#include "vtkCloudSurface.h"
#include "vtkCloudTerrain.h"
#include "vtkCloudUniformMedium.h"
#include "vtkCloudWater.h"
#include "vtkCloudscape.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace nephoscope
{
namespace
{
constexpr double Infinite = std::numeric_limits<double>::infinity();

/// Beyond this optical depth nothing is seen, and nothing takes time.
constexpr double SeenDepth = 20;

std::string number(double value)
{
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

double largest(const double v[3])
{
  return std::max({ v[0], v[1], v[2] });
}

/// A height field as its source's output has it.
struct Field
{
  HeightFieldShape shape;
  double height = 0;
  double wave = Infinite;  ///< the shortest
  double above = Infinite; ///< no top is higher over the plane
  double below = 0;        ///< no bottom is deeper
};

std::optional<Field> fieldOf(vtkAlgorithm* algorithm, int port)
{
  if (algorithm->GetNumberOfInputConnections(port) == 0)
  {
    return std::nullopt;
  }
  vtkAlgorithm* const source = algorithm->GetInputAlgorithm(port, 0);
  source->Update();
  vtkDataObject* const data = algorithm->GetInputDataObject(port, 0);
  auto* const numbers = data
    ? vtkDoubleArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(arrays::HeightField))
    : nullptr;
  Field field;
  if (!numbers ||
    !shapeOf(numbers->GetPointer(0), static_cast<std::size_t>(numbers->GetNumberOfValues()),
      field.shape, field.height))
  {
    return std::nullopt;
  }
  const HeightField heights(field.shape);
  field.wave = heights.shortestWave();
  const double most = heights.upperBound();
  field.above = most > 0 ? heights.top(most) : 0;
  field.below = most > 0 ? field.shape.depth : 0;
  return field;
}

SceneOption leftOut(double bound, std::function<void()> apply)
{
  SceneOption option;
  option.name = "left out";
  option.model = "nothing";
  option.bound = bound;
  option.leavesOut = true;
  option.apply = std::move(apply);
  return option;
}

/// A body that is drawn by its only method.
ScenePart only(const std::string& name, const std::string& model, const std::vector<double>& work)
{
  SceneOption option;
  option.name = "as it is";
  option.model = model;
  option.work = work;
  option.exact = true;
  option.apply = [] {};
  return { name, { option } };
}

/// A part of a height-field cloud's methods as settings of its body.
struct HeightFieldUse
{
  const char* method;
  double step;
  double samples;
  double spacing; ///< of slices, pixels; 0: one for each
};

void addOption(
  ScenePart& part, vtkCloudHeightField* body, SceneOption option, const HeightFieldUse& use)
{
  option.apply = [body, use]
  {
    body->SetVisibility(true);
    body->SetMethod(use.method);
    body->SetStep(use.step > 0 ? use.step : body->GetStep());
    body->SetSamplesPerWave(use.samples);
    body->SetSliceSpacing(use.spacing);
  };
  part.options.push_back(std::move(option));
}

/// What the samples of a height field's slices are measured by.
struct Waves
{
  double shortest; ///< m
  double pixel;    ///< width of one at the clouds, over the shortest wave
};

std::string samplesText(double samples)
{
  return number(samples) + " samples of the shortest wave";
}

/// Samples of a slice: a number for each wave, or one for each pixel where a wave is not seen as wide as that.
double samplesOf(const View& view, double wave, double samples, double far)
{
  const double spacing = wave / samples;
  const double growth = view.camera.isParallel() ? 0 : view.camera.pixel() * 12 / samples;
  const double dense = growth > 0 ? std::min(far, spacing / growth) : far;
  return dense / spacing + (far > dense ? std::log(far / dense) / growth : 0);
}

void addSharedSlices(
  const View& view, vtkCloudHeightField* body, const Waves& waves, ScenePart& part)
{
  constexpr double samples = 12;
  const double count = samplesOf(view, waves.shortest, samples, body->GetFarDistance());
  for (const double spacing : { 0.8, 0.2, 0.05 })
  {
    SceneOption option;
    option.name = "Moments, " + samplesText(samples) + ", slices shared by pixels, " +
      number(spacing) + " apart";
    option.model = "height field Moments shared";
    option.work = { view.rays, 1.6 * view.camera.width() / spacing * count };
    option.coarseness = spacing * waves.pixel;
    addOption(part, body, option, { "Moments", 0, samples, spacing });
  }
}

void addMoments(const View& view, vtkCloudHeightField* body, const Waves& waves, ScenePart& part)
{
  const bool columns = !view.camera.isParallel() && view.camera.up()[2] > 1 - 1e-12;
  for (const double samples : { 6.0, 12.0, 36.0, 120.0 })
  {
    const double count = samplesOf(view, waves.shortest, samples, body->GetFarDistance());
    SceneOption option;
    option.name = "Moments, " + samplesText(samples);
    option.model = "height field Moments";
    option.work = { view.rays, (columns ? view.camera.width() : view.rays) * count };
    option.coarseness = std::max(1 / samples, waves.pixel);
    addOption(part, body, option, { "Moments", 0, samples, 0 });
    if (samples == 12)
    {
      option.name = "Sexp1986";
      option.model = "height field Sexp1986";
      option.coarseness = 1;
      addOption(part, body, option, { "Sexp1986", 0, samples, 0.8 });
    }
  }
  if (!columns && !view.camera.isParallel())
  {
    addSharedSlices(view, body, waves, part);
  }
}

ScenePart heightFieldPart(const View& view, vtkCloudHeightField* body)
{
  const Field field = fieldOf(body, 0).value_or(Field());
  const double density =
    std::max(bounded(body->GetSunExtinction()), bounded(body->GetViewExtinction()));
  const double far = body->GetFarDistance();
  const double wave = std::min(field.wave, far);
  const double low = field.height - field.below;
  const double high = field.height + std::min(field.above, far);
  const double path = view.lengthBetween(low, high, far, Infinite);
  ScenePart part{ "light in height-field clouds", {} };
  addMoments(
    view, body, { wave, view.camera.footprint(view.distanceOf(low, high, far)) / wave }, part);
  for (const double depth : { 0.3, 0.1, 0.03, 0.01, 0.003 })
  {
    const double step = depth / std::max(density, 1e-12);
    SceneOption option;
    option.name = "March, steps of " + number(step) + " m";
    option.model = "height field March";
    option.work = { view.rays, view.rays * path / step };
    option.coarseness = depth;
    addOption(part, body, option, { "March", step, 12, 0 });
  }
  SceneOption exact;
  exact.name = "Exact";
  exact.model = "height field Exact";
  exact.work = { view.rays, view.rays * path / wave };
  exact.exact = true;
  addOption(part, body, exact, { "Exact", 0, 12, 0 });
  const double depth = std::max(density, bounded(body->GetBackgroundExtinction())) *
    (field.above > 0 ? far + field.above + field.below : 0);
  const double g = std::abs(body->GetAsymmetry());
  const double source =
    largest(body->GetSunColor()) * (1 + g) / ((1 - g) * (1 - g)) + largest(body->GetSkyColor());
  part.options.push_back(
    leftOut(errorOfLeavingOut(depth, source), [body] { body->SetVisibility(false); }));
  return part;
}

/// The input by which a body is told of the clouds' shadow; -1 if it is not.
int shadowPort(vtkCloudBody* body)
{
  for (int port = 0; port < body->GetNumberOfInputPorts(); ++port)
  {
    if (body->GetNumberOfInputConnections(port) > 0 &&
      body->GetInputAlgorithm(port, 0)->IsA("vtkCloudHeightFieldShadow"))
    {
      return port;
    }
  }
  return -1;
}

/// The grid of the shadow that a haze has shafts of; without one, the spacing is 0.
struct ShaftGrid
{
  double spacing = 0;
  double reach = 0; ///< from its middle to a corner
  double points = 0;
  double top = 0; ///< of the haze
};

ShaftGrid shaftGridOf(vtkCloudHaze* body)
{
  ShaftGrid grid;
  grid.top = body->GetHeight();
  const int port = shadowPort(body);
  if (port < 0)
  {
    return grid;
  }
  vtkAlgorithm* const shadow = body->GetInputAlgorithm(port, 0);
  shadow->UpdateInformation();
  vtkInformation* const info = shadow->GetOutputInformation(0);
  const int* const extent = info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  const double across = extent[1] - extent[0];
  const double along = extent[3] - extent[2];
  grid.spacing = info->Get(vtkDataObject::SPACING())[0];
  grid.reach = grid.spacing * std::hypot(across, along) / 2;
  grid.points = (across + 1) * (along + 1);
  grid.top = fieldOf(shadow, 0).value_or(Field()).height;
  return grid;
}

struct HazeUse
{
  int method;
  double step;
  int radials;
};

void addOption(ScenePart& part, vtkCloudHaze* body, SceneOption option, const HazeUse& use)
{
  option.apply = [body, use]
  {
    body->SetVisibility(true);
    body->SetMethod(use.method);
    body->SetStep(use.step > 0 ? use.step : body->GetStep());
    body->SetRadials(use.radials);
  };
  part.options.push_back(std::move(option));
}

/// Tables are of one eye, and of clouds.
void addHazeMoments(const View& view, vtkCloudHaze* body, const ShaftGrid& grid, ScenePart& part)
{
  for (const int radials : { 256, 512, 1024, 2048, 4096 })
  {
    SceneOption option;
    option.name = "Moments, " + std::to_string(radials) + " directions";
    option.model = "haze Moments";
    option.work = { grid.points, static_cast<double>(radials) * radials, view.rays };
    option.coarseness = grid.reach / (radials * grid.spacing);
    addOption(part, body, option, { vtkCloudHaze::Moments, 0, radials });
  }
}

void addHazeMarch(
  const View& view, vtkCloudHaze* body, const ShaftGrid& grid, double path, ScenePart& part)
{
  const bool shafts = grid.spacing > 0;
  const double unit = shafts ? grid.spacing : 1 / std::max(largest(body->GetExtinction()), 1e-30);
  for (const double steps : { 8.0, 2.0, 0.5, 0.125 })
  {
    const double step = steps * unit * (shafts ? 1 : 0.1);
    SceneOption option;
    option.name = "March, steps of " + number(step) + " m";
    option.model = shafts ? "haze March" : "haze March without clouds";
    option.work = { view.rays, view.rays * path / step };
    if (shafts)
    {
      option.work.insert(option.work.begin(), grid.points);
    }
    option.coarseness = step / unit;
    addOption(part, body, option, { vtkCloudHaze::March, step, 1024 });
  }
}

ScenePart hazePart(const View& view, vtkCloudHaze* body)
{
  const ShaftGrid grid = shaftGridOf(body);
  const double density = largest(body->GetExtinction());
  const double seen = std::min(SeenDepth / std::max(density, 1e-30), body->GetRange());
  const double path = view.lengthBetween(-1e30, grid.top, 1e30, seen);
  ScenePart part{ "light in haze", {} };
  if (grid.spacing > 0 && !view.camera.isParallel())
  {
    addHazeMoments(view, body, grid, part);
  }
  addHazeMarch(view, body, grid, path, part);
  SceneOption exact;
  exact.name = "Exact";
  exact.model = "haze without clouds";
  exact.work = { view.rays };
  if (grid.spacing > 0)
  {
    exact.model = "haze Exact";
    exact.work = { grid.points, view.rays * path / grid.spacing, view.rays };
  }
  exact.exact = true;
  addOption(part, body, exact, { vtkCloudHaze::Exact, 0, 1024 });
  const double g = std::abs(body->GetAnisotropy());
  const double source =
    largest(body->GetSunColor()) * largest(body->GetAlbedo()) * (1 + g) / (4 * (1 - g) * (1 - g)) +
    largest(body->GetSkyColor());
  const double depth = density * std::min(body->GetRange(), 1e300);
  part.options.push_back(
    leftOut(errorOfLeavingOut(depth, source), [body] { body->SetVisibility(false); }));
  return part;
}

ScenePart mediumPart(const View& view, vtkCloudUniformMedium* body)
{
  ScenePart part = only("uniform haze", "uniform haze", { view.rays });
  part.options[0].apply = [body] { body->SetVisibility(true); };
  part.options.push_back(
    leftOut(errorOfLeavingOut(largest(body->GetExtinction()) * std::min(body->GetRange(), 1e300),
              largest(body->GetColor())),
      [body] { body->SetVisibility(false); }));
  return part;
}

/// The longest way of a ray through a data set.
double longestWay(vtkDataSet* grid)
{
  double bounds[6];
  grid->GetBounds(bounds);
  return std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
}

/// Extinctions that may be left out of ways through a grid with at most these errors.
std::vector<double> extinctionsFor(const std::vector<double>& errors, double way, double source)
{
  std::vector<double> least;
  for (const double error : errors)
  {
    const double dark = error * DarkestRadiance / std::max(source, 1e-30);
    const double depth = std::min(std::log1p(error), -std::log1p(-std::min(0.5, dark)));
    least.push_back(depth / std::max(way, 1e-30));
  }
  return least;
}

int translucentBodies(vtkCloudscape* scape)
{
  int count = 0;
  for (int i = 0; i < scape->GetNumberOfBodies(); ++i)
  {
    count += scape->GetBody(i)->GetVisibility() && !scape->GetBody(i)->IsOpaque() ? 1 : 0;
  }
  return count;
}

ScenePart cellPart(const View& view, vtkCloudscape* scape, vtkCloudCellVolume* body)
{
  const std::vector<double> errors{ 0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2 };
  ScenePart part{ "cells", {} };
  body->CountPoints({}); // brings the input up to date
  auto* const grid = vtkDataSet::SafeDownCast(body->GetInputDataObject(0, 0));
  const std::vector<double> least =
    extinctionsFor(errors, grid ? longestWay(grid) : 1, largest(body->GetColor()));
  const std::vector<vtkIdType> counts = body->CountPoints(least);
  if (counts.empty())
  {
    return part; // the picture will say why
  }
  const bool summed = !scape->GetComputeDepth() && translucentBodies(scape) == 1 &&
    !grid->GetPointData()->HasArray(arrays::SourceColor);
  const auto add = [&](int order, const std::string& name, std::size_t i)
  {
    const auto points = static_cast<double>(counts[i]);
    SceneOption option;
    option.name = name +
      (i == 0 ? std::string()
              : ", without " + std::to_string(counts[0] - counts[i]) + " of " +
            std::to_string(counts[0]) + " points below " + number(least[i]) + " per scene unit");
    option.model = "cells " + name;
    option.work = { points, view.rays * std::cbrt(points) };
    option.bound = errors[i];
    option.exact = order == vtkCloudCellVolume::PixelDepth && i == 0;
    option.leavesOut = i > 0;
    option.apply = [body, order, value = i == 0 ? 0 : least[i]]
    {
      body->SetOrder(order);
      body->SetLeastExtinction(value);
    };
    part.options.push_back(std::move(option));
  };
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    if (i == 0 || counts[i] < counts[i - 1])
    {
      add(vtkCloudCellVolume::PixelDepth, summed ? "summed" : "PixelDepth", i);
    }
  }
  add(vtkCloudCellVolume::Visibility, "Visibility", 0);
  add(vtkCloudCellVolume::Centroid, "Centroid", 0);
  return part;
}

ScenePart surfacePart(const View& view, vtkCloudSurface* body)
{
  body->GetInputAlgorithm(0, 0)->Update();
  auto* const mesh = vtkDataSet::SafeDownCast(body->GetInputDataObject(0, 0));
  const double triangles = mesh ? static_cast<double>(mesh->GetNumberOfCells()) : 0;
  if (body->GetOpacityMode() != vtkCloudSurface::OpacityFromTexture || !mesh)
  {
    return only("surface", "surface", { triangles, view.rays });
  }
  // The nearest that the surface may be to the eye, and so the finest that a pixel may be.
  double bounds[6];
  mesh->GetBounds(bounds);
  double square = 0;
  for (int c = 0; c < 3; ++c)
  {
    const double eye = view.camera.eye()[c];
    square += std::pow(std::max({ bounds[2 * c] - eye, eye - bounds[2 * c + 1], 0.0 }), 2);
  }
  CloudTextureParameters parameters;
  parameters.wavelength = body->GetTextureWavelength();
  parameters.octaves = body->GetTextureOctaves();
  const int terms = CloudTexture(parameters).termsAt(view.camera.footprint(std::sqrt(square)));
  ScenePart part = only("texture", "texture", { triangles, view.rays, view.rays * terms });
  part.options[0].name = std::to_string(terms) + " of " + std::to_string(parameters.octaves) +
    " terms; the others are nowhere as long as four pixels";
  part.options[0].leavesOut = terms < parameters.octaves;
  return part;
}

/// The shadow of the clouds on all that has it.
std::optional<ScenePart> shadowPart(const std::vector<vtkCloudBody*>& bodies)
{
  vtkAlgorithm* shadow = nullptr;
  std::optional<double> density;
  std::vector<std::pair<vtkCloudBody*, int>> shaded;
  for (vtkCloudBody* const body : bodies)
  {
    if (auto* const clouds = vtkCloudHeightField::SafeDownCast(body))
    {
      density = std::max(density.value_or(0), bounded(clouds->GetSunExtinction()));
    }
    const int port = shadowPort(body);
    if (port >= 0)
    {
      shadow = body->GetInputAlgorithm(port, 0);
      shaded.emplace_back(body, port);
    }
  }
  if (!shadow)
  {
    return std::nullopt;
  }
  const auto use = [shaded](bool used)
  {
    for (const auto& [body, port] : shaded)
    {
      body->SetInputUse(port, used);
    }
  };
  shadow->UpdateInformation();
  const int* const extent =
    shadow->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  ScenePart part = only("shadow of the clouds", "shadow",
    { (extent[1] - extent[0] + 1.0) * (extent[3] - extent[2] + 1.0) });
  part.options[0].name = "drawn";
  part.options[0].apply = [use] { use(true); };
  const Field field = fieldOf(shadow, 0).value_or(Field());
  if (density) // else there are no clouds that say how dense they are
  {
    part.options.push_back(
      leftOut(errorOfLeavingOut(*density * (field.above + field.below), 1), [use] { use(false); }));
  }
  return part;
}

void addPartsOf(
  vtkCloudBody* body, const View& view, vtkCloudscape* scape, std::vector<ScenePart>& parts)
{
  if (auto* const clouds = vtkCloudHeightField::SafeDownCast(body))
  {
    parts.push_back(heightFieldPart(view, clouds));
  }
  else if (auto* const haze = vtkCloudHaze::SafeDownCast(body))
  {
    parts.push_back(hazePart(view, haze));
  }
  else if (auto* const medium = vtkCloudUniformMedium::SafeDownCast(body))
  {
    parts.push_back(mediumPart(view, medium));
  }
  else if (auto* const volume = vtkCloudCellVolume::SafeDownCast(body))
  {
    parts.push_back(cellPart(view, scape, volume));
  }
  else if (auto* const surface = vtkCloudSurface::SafeDownCast(body))
  {
    parts.push_back(surfacePart(view, surface));
  }
  else
  {
    const std::string model = body->IsA("vtkCloudGround") ? "ground"
      : body->IsA("vtkCloudTerrain")                      ? "terrain"
      : body->IsA("vtkCloudWater")                        ? "water"
                                                          : "nothing";
    parts.push_back(only(model == "nothing" ? body->GetClassName() : model, model, { view.rays }));
  }
}
}

std::vector<ScenePart> partsOf(vtkCloudscape* scape)
{
  const View view(scape);
  std::vector<ScenePart> parts{ only("picture", "picture", { 1, view.rays }) };
  std::vector<vtkCloudBody*> bodies;
  for (int i = 0; i < scape->GetNumberOfBodies(); ++i)
  {
    bodies.push_back(scape->GetBody(i));
    addPartsOf(bodies.back(), view, scape, parts);
  }
  if (std::optional<ScenePart> shadow = shadowPart(bodies))
  {
    parts.push_back(std::move(*shadow));
  }
  return parts;
}
}
