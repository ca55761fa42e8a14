// SPDX-License-Identifier: BSD-3-Clause
#include "SceneBuilder.h"

#include "Daylight.h"
#include "Failure.h"
#include "FittedConstants.h"
#include "Messages.h"
#include "ModelFile.h"
#include "Progress.h"
#include "SceneView.h"

#include <CloudArrays.h>
#include <NumberText.h>
#include <vtkCamera.h>
#include <vtkCloudCellVolume.h>
#include <vtkCloudContour.h>
#include <vtkCloudGlobe.h>
#include <vtkCloudGradedBackdrop.h>
#include <vtkCloudHaze.h>
#include <vtkCloudHeightField.h>
#include <vtkCloudHeightFieldShadow.h>
#include <vtkCloudHeightFieldSource.h>
#include <vtkCloudNetCDFReader.h>
#include <vtkCloudPlane.h>
#include <vtkCloudSmooth.h>
#include <vtkCloudSurface.h>
#include <vtkCloudTerrain.h>
#include <vtkCloudTerrainSource.h>
#include <vtkCloudUniformMedium.h>
#ifdef NEPHOSCOPE_OPENVDB
#include <vtkCloudVDBReader.h>
#include <vtkCloudVoxelVolume.h>
#endif
#include <vtkCloudWater.h>
#include <vtkCloudscape.h>
#include <vtkMath.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStructuredGrid.h>

#include <cmath>

namespace nephoscope::program
{
namespace
{
bool holds(vtkStructuredGrid* grid, const char* array)
{
  return grid->GetPointData()->GetArray(array) != nullptr;
}

bool isSurface(const Body& body)
{
  return std::holds_alternative<SurfaceBody>(body) || std::holds_alternative<TextureBody>(body);
}

// A density emitter shows no more of a cloud than an optical depth of about 3; a model's clouds have 10 to 100.
constexpr double CondensateScale = 0.05;

// Fine enough that the moment of any frame is one of these.
constexpr int MomentsOfCycle = 352800;

// Optical depth of the haze between the eye and the middle of regional clouds.
constexpr double HazeDepth = 0.2;

/// Turns the parts of a scene into bodies, one after the other.
class Builder
{
public:
  Builder(const Scene& scene, vtkStructuredGrid* grid, const Extent& lie, Progress& progress)
    : Parts(scene)
    , Watch(progress)
    , Grid(grid)
    , Lie(lie)
  {
    this->Built.scape = vtkSmartPointer<vtkCloudscape>::New();
    this->Built.cells = grid ? grid->GetNumberOfCells() : 0;
  }

  void lay(bool addGround);

  void operator()(const SurfaceBody& body) { this->addSurface(body, false); }

  void operator()(const TextureBody& body)
  {
    const double metre =
      this->Lie.isGlobe() || this->Lie.geometry == "Local" ? 1 : this->Lie.heightScale;
    const bool moves = body.advect && holds(this->Grid, arrays::TextureCoordinates);
    vtkCloudSurface* const surface = this->addSurface(body, moves);
    surface->SetOpacityModeToTexture();
    // Coordinates that move are in metres, the places of points in scene units.
    surface->SetTextureWavelength(moves && body.wavelength ? *body.wavelength * 1000
        : body.wavelength                                  ? *body.wavelength * 1000 * metre
        : this->Lie.isGlobe() && this->Lie.global          ? this->Lie.planetRadius / 4
                                                           : 4 * this->Lie.gridStep);
    surface->SetTextureOctaves(body.octaves);
    surface->SetTextureOffset(body.offset);
    surface->SetTextureThreshold(body.threshold);
    // Flat clouds of a map are seen aslant everywhere, those of a globe at its limb: that is no outline to fray.
    surface->SetTextureRimThreshold(
      body.rimThreshold.value_or(this->Lie.isGlobe() ? 0.2 : body.threshold));
    surface->SetTextureRange(body.range);
    surface->SetTextureSeed(body.seed);
  }

  void operator()(const VolumeBody& body)
  {
    const bool condensate = this->isCondensate(body);
    const vtkNew<vtkCloudCellVolume> volume;
    volume->SetInputData(body.sunlit && this->Lie.isGlobe() ? this->inSunlight() : this->Grid);
    volume->SetExtinctionRule(
      condensate ? vtkCloudCellVolume::Condensate : vtkCloudCellVolume::CloudFraction);
    volume->SetFullCoverExtinction(body.extinction / 1000);
    volume->SetExtinctionScale(body.scale.value_or(condensate ? CondensateScale : 1));
    volume->SetLiquidRadius(body.liquidRadius * 1e-6);
    volume->SetIceRadius(body.iceRadius * 1e-6);
    volume->SetColor(body.color.data());
    volume->SetOrder(body.order == "visibility" ? vtkCloudCellVolume::Visibility
        : body.order == "centroid"              ? vtkCloudCellVolume::Centroid
                                                : vtkCloudCellVolume::PixelDepth);
    this->Built.scape->AddBody(volume);
    if (condensate && !body.scale)
    {
      note(this->Parts.data.file +
        ": the condensate's extinction is multiplied by 0.05, so that its structure shows; a scene "
        "with scale: 1 "
        "has the physical one");
    }
  }

  void operator()(const GlobeBody& body)
  {
    this->requireGeometry(this->Lie.isGlobe(), "globe", "plane");
    const vtkNew<vtkCloudGlobe> globe;
    globe->SetRadius(this->Lie.planetRadius);
    this->addGround(globe, body);
  }

  void operator()(const PlaneBody& body)
  {
    this->requireGeometry(!this->Lie.isGlobe(), "plane", "globe");
    const vtkNew<vtkCloudPlane> plane;
    plane->SetHeight(body.height * this->Lie.heightScale);
    this->addGround(plane, body);
  }

  void operator()(const TerrainBody& body)
  {
    const vtkNew<vtkCloudTerrainSource> hills;
    const int points = 1 + static_cast<int>(std::ceil(1000 * body.extent / body.spacing));
    hills->SetDimensions(points, points);
    hills->SetSpacing(body.spacing);
    hills->SetCenter(body.center.data());
    hills->SetWavelength(1000 * body.wavelength);
    hills->SetRelief(body.relief);
    hills->SetMean(body.mean + body.center[2]);
    hills->SetGain(body.gain);
    hills->SetSeed(body.seed);
    const vtkNew<vtkCloudTerrain> terrain;
    terrain->SetInputConnection(hills->GetOutputPort());
    this->light(terrain);
    this->Built.scape->AddBody(terrain);
    this->Hills = hills;
    this->Shaded.emplace_back(terrain, 1);
  }

  void operator()(const WaterBody& body)
  {
    const vtkNew<vtkCloudWater> water;
    const double direction = body.direction * vtkMath::Pi() / 180;
    water->SetLevel(body.level);
    water->SetWindSpeed(body.wind);
    water->SetWind(std::sin(direction), std::cos(direction), 0);
    water->SetWavelength(body.wavelength);
    water->SetWaterColor(body.color.data());
    water->SetTime(this->Parts.moment * body.duration);
    water->SetPeriod(this->Parts.animation.cycle ? body.duration : 0);
    water->SetBackdrop(this->Built.scape->GetBackdrop());
    this->light(water);
    this->Built.scape->AddBody(water);
    this->Waters.emplace_back(water);
    this->Shaded.emplace_back(water, 0);
  }

  void operator()(const HeightFieldBody& body)
  {
    const vtkNew<vtkCloudHeightFieldSource> shape;
    shape->SetPlaneHeight(body.height);
    shape->SetCover(body.cover);
    shape->SetWavelength(body.wavelength);
    shape->SetRelief(body.relief);
    shape->SetRoundness(body.roundness);
    shape->SetBaseDepth(body.baseDepth);
    shape->SetNumberOfWaves(body.waves);
    shape->SetNumberOfBillows(body.billows);
    shape->SetShortening(body.shortening);
    shape->SetSmoothness(body.smoothness);
    shape->SetSeed(body.seed);
    shape->SetCycleVector(body.travel.data());
    shape->SetFrames(MomentsOfCycle);
    shape->SetFrame(static_cast<int>(std::lround(this->Parts.moment * MomentsOfCycle)));
    const vtkNew<vtkCloudHeightField> clouds;
    clouds->SetInputConnection(shape->GetOutputPort());
    clouds->SetMethod(body.method);
    clouds->SetSunExtinction(body.extinction[0] / 1000);
    clouds->SetViewExtinction(body.extinction[1] / 1000);
    clouds->SetBackgroundExtinction(body.extinction[2] / 1000);
    if (body.method == "Sexp1986")
    {
      setConstants(clouds, body);
    }
    clouds->SetAsymmetry(body.asymmetry);
    clouds->SetFarDistance(body.far * 1000);
    this->light(clouds);
    double sun[3];
    clouds->GetSunColor(sun);
    clouds->SetSunColor(body.sunlight * sun[0], body.sunlight * sun[1], body.sunlight * sun[2]);
    this->Built.scape->AddBody(clouds);
    this->Clouds = clouds;
    const auto shadow = vtkSmartPointer<vtkCloudHeightFieldShadow>::New();
    shadow->SetInputConnection(shape->GetOutputPort());
    this->placeShadow(shadow, body);
    this->Shadow = shadow;
  }

  void operator()(const VoxelBody& body);

  void operator()(const UniformMedium& medium)
  {
    this->addHaze(medium.extinction / 1000, medium.color);
  }

  void operator()(const HazeMedium& medium)
  {
    const vtkNew<vtkCloudHaze> haze;
    haze->SetExtinction(
      medium.extinction[0] / 1000, medium.extinction[1] / 1000, medium.extinction[2] / 1000);
    haze->SetAlbedo(medium.albedo, medium.albedo, medium.albedo);
    haze->SetAnisotropy(medium.anisotropy);
    double sun[3];
    haze->GetSunColor(sun);
    haze->SetSunColor(medium.sunlight * sun[0], medium.sunlight * sun[1], medium.sunlight * sun[2]);
    haze->SetSkyColor(medium.sky.data());
    haze->SetTowardSun(this->TowardSun.v);
    haze->SetHeight(medium.height * this->Lie.heightScale);
    haze->SetMethod(medium.method == "exact" ? vtkCloudHaze::Exact
        : medium.method == "march"           ? vtkCloudHaze::March
                                             : vtkCloudHaze::Moments);
    haze->SetStep(medium.step);
    this->Built.scape->AddBody(haze);
    this->Shaded.emplace_back(haze, 0);
  }

  BuiltScene finish()
  {
    this->joinLandscape();
    this->Built.filterSeconds = this->Clock.lap();
    return this->Built;
  }

private:
  bool isCondensate(const VolumeBody& body) const;
  vtkSmartPointer<vtkStructuredGrid> inSunlight();
  vtkCloudSurface* addSurface(const SurfaceBody& body, bool keepCoordinates);
  void addGround(vtkCloudGround* ground, const Ground& look);
  void addHaze(double extinction, const Triple& color);
  void joinLandscape();
  void placeShadow(vtkCloudHeightFieldShadow* shadow, const HeightFieldBody& body);
  void light(vtkCloudLitBody* body);
  void requireGeometry(bool fits, const std::string& ground, const std::string& other) const;

  const Scene& Parts;
  Progress& Watch;
  Stopwatch Clock;
  vtkSmartPointer<vtkStructuredGrid> Grid;
  const Extent& Lie;
  Vector3 TowardSun{ 0, 0, 1 };
  BuiltScene Built;
  vtkSmartPointer<vtkAlgorithm> Hills;
  vtkSmartPointer<vtkAlgorithm> Shadow; // of the clouds
  vtkSmartPointer<vtkCloudHeightField> Clouds;
  std::vector<vtkSmartPointer<vtkCloudWater>> Waters;
  std::vector<std::pair<vtkSmartPointer<vtkCloudBody>, int>> Shaded; // and the port for the shadow
};

#ifdef NEPHOSCOPE_OPENVDB
void Builder::operator()(const VoxelBody& body)
{
  const vtkNew<vtkCloudVDBReader> reader;
  reader->SetFileName(body.file.c_str());
  reader->SetGridName(body.grid);
  reader->Update();
  Messages::throwIfError(body.file);
  const vtkNew<vtkCloudVoxelVolume> voxels;
  voxels->SetInputConnection(reader->GetOutputPort());
  voxels->SetExtinctionScale(body.extinction);
  voxels->SetAlbedo(body.albedo);
  voxels->SetAsymmetry(body.asymmetry);
  this->light(voxels);
  double sun[3];
  voxels->GetSunColor(sun);
  voxels->SetSunColor(body.sunlight * sun[0], body.sunlight * sun[1], body.sunlight * sun[2]);
  this->Built.scape->AddBody(voxels);
}
#else
void Builder::operator()(const VoxelBody& body)
{
  throw Failure(body.file +
    ": this nephoscope was built without OpenVDB; install libopenvdb-dev and build it again");
}
#endif

/// The shadow of the clouds about the eye.
void Builder::placeShadow(vtkCloudHeightFieldShadow* shadow, const HeightFieldBody& body)
{
  constexpr int Points = 1601;
  const double spacing = 1000 * body.shadows / (Points - 1);
  double eye[3];
  this->Built.scape->GetCamera()->GetPosition(eye);
  shadow->SetExtinction(body.extinction[0] / 1000);
  shadow->SetDimensions(Points, Points);
  shadow->SetSpacing(spacing);
  // Points of the plane that stand still when the eye moves.
  shadow->SetCenter(spacing * std::round(eye[0] / spacing), spacing * std::round(eye[1] / spacing));
}

/// Bodies may stand in any order in a scene: what sees others is told of them at the end.
void Builder::joinLandscape()
{
  for (const auto& water : this->Waters)
  {
    water->SetClouds(this->Clouds);
    if (this->Hills)
    {
      water->SetInputConnection(1, this->Hills->GetOutputPort());
    }
  }
  for (const auto& [body, port] : this->Shaded)
  {
    if (this->Shadow)
    {
      body->SetInputConnection(port, this->Shadow->GetOutputPort());
    }
  }
}

void refuseBuriedEye(bool buried, const std::string& remedy)
{
  if (buried)
  {
    throw UsageFailure("--view: the eye stands in " + remedy);
  }
}

void Builder::lay(bool addGround)
{
  const auto camera = cameraOf(this->Parts.camera, this->Lie, this->Parts.picture.size);
  Vector3 eye;
  camera->GetPosition(eye.v);
  this->TowardSun = towardSunOf(this->Parts.light, this->Lie, camera);
  this->Built.scape->SetCamera(camera);
  this->Built.scape->SetCylinderAngle(this->Parts.camera.cylinder.value_or(0));
  this->Built.scape->SetSize(this->Parts.picture.size.data());
  this->Built.scape->SetSamples(this->Parts.picture.samples);
  this->Built.scape->SetBackdrop(backdropOf(this->Parts.backdrop, this->Lie));
  if (addGround && this->Lie.isGlobe())
  {
    (*this)(GlobeBody());
    refuseBuriedEye(length(eye) <= this->Lie.planetRadius, "the planet; give a distance over 1");
  }
  else if (addGround)
  {
    (*this)(PlaneBody());
    refuseBuriedEye(eye[2] <= 0, "the ground; give an elevation over 0");
    this->addHaze(HazeDepth / camera->GetDistance(), Triple{ 0.42, 0.57, 0.8 });
  }
}

bool Builder::isCondensate(const VolumeBody& body) const
{
  const bool condensate =
    holds(this->Grid, arrays::LiquidWater) || holds(this->Grid, arrays::IceWater);
  if (body.quantity == "condensate" && !condensate)
  {
    throw Failure(this->Parts.data.file +
      ": has no condensate to draw; name it with --variable LiquidWater=NAME, or draw the "
      "fraction");
  }
  if (body.quantity == "automatic" && !holds(this->Grid, arrays::CloudFraction))
  {
    note(this->Parts.data.file +
      ": has no cloud fraction; the volume's density is that of its condensate");
    return true;
  }
  return body.quantity == "condensate";
}

/// The grid with the light that cloud surfaces have.
vtkSmartPointer<vtkStructuredGrid> Builder::inSunlight()
{
  const vtkNew<vtkCloudSurface> look;
  this->light(look);
  SurfaceShade shade;
  shade.towardSun = this->TowardSun;
  look->GetSunColor(shade.sun.v);
  look->GetSkyColor(shade.sky.v);
  shade.ambient = look->GetAmbient();
  shade.wrap = look->GetWrap();
  return inDaylight(this->Grid, shade);
}

vtkCloudSurface* Builder::addSurface(const SurfaceBody& body, bool keepCoordinates)
{
  const vtkNew<vtkStructuredGrid> grid;
  grid->ShallowCopy(this->Grid);
  if (!keepCoordinates)
  {
    grid->GetPointData()->RemoveArray(arrays::TextureCoordinates);
  }
  const vtkNew<vtkCloudSmooth> smooth;
  const vtkNew<vtkCloudContour> contour;
  const vtkNew<vtkCloudSurface> surface;
  if (body.smoothing > 0)
  {
    smooth->SetInputData(grid);
    smooth->SetLength(body.smoothing * this->Lie.gridStep);
    contour->SetInputConnection(smooth->GetOutputPort());
  }
  else
  {
    contour->SetInputData(grid);
  }
  contour->SetValue(0, body.value);
  this->Watch.watch(contour, "contour");
  contour->Update();
  this->Watch.forget();
  Messages::throwIfError(this->Parts.data.file);
  if (contour->GetOutput()->GetNumberOfCells() == 0)
  {
    note(this->Parts.data.file + ": no cloud has the fraction " + numberText(body.value) +
      "; try another --value");
  }
  this->Built.triangles += contour->GetOutput()->GetNumberOfCells();
  surface->SetInputConnection(contour->GetOutputPort());
  surface->SetOpacity(body.opacity);
  surface->SetColor(body.color.data());
  this->light(surface);
  this->Built.scape->AddBody(surface);
  return surface;
}

void Builder::addGround(vtkCloudGround* ground, const Ground& look)
{
  ground->SetSeaColor(look.seaColor.data());
  ground->SetLandColor(look.landColor.data());
  ground->SetGraticule(look.graticule);
  this->light(ground);
  this->Built.scape->AddBody(ground);
}

/// Haze of an extinction per scene unit.
void Builder::addHaze(double extinction, const Triple& color)
{
  const vtkNew<vtkCloudUniformMedium> haze;
  haze->SetExtinction(extinction, extinction, extinction);
  haze->SetColor(color.data());
  this->Built.scape->AddBody(haze);
}

void Builder::requireGeometry(bool fits, const std::string& ground, const std::string& other) const
{
  if (!fits)
  {
    throw UsageFailure("a '" + ground + "' is no ground for " + this->Parts.data.file +
      ", whose geometry is " + this->Lie.geometry + "; use '" + other +
      "', or choose another geometry");
  }
}

void Builder::light(vtkCloudLitBody* body)
{
  body->SetTowardSun(this->TowardSun.v);
  body->SetAmbient(this->Parts.light.ambient);
}
}

SceneData readData(const Scene& scene, Progress& progress)
{
  const Data& data = scene.data;
  SceneData read;
  read.reader = openModelFile(data);
  progress.watch(read.reader, "read");
  // A volume can be drawn of condensate alone; a surface needs a fraction.
  bool needsFraction = false;
  for (const Body& body : scene.bodies)
  {
    const auto* const volume = std::get_if<VolumeBody>(&body);
    needsFraction = needsFraction || isSurface(body) || (volume && volume->quantity == "fraction");
  }
  read.grid = readStep(read.reader, data.time, needsFraction);
  read.lie = extentOf(read.grid);
  if (!data.exaggeration)
  {
    const double factor = exaggerationOf(read.lie);
    read.reader->SetVerticalExaggeration(factor);
    read.reader->Update();
    Messages::throwIfError(data.file);
    Messages::takeWarnings(); // they are those of the first reading
    read.lie = extentOf(read.grid);
  }
  if (read.grid->GetNumberOfCells() == 0 || read.grid->GetDataDimension() < 3)
  {
    throw Failure(data.file + ": has one column or one level only; a picture needs two each way");
  }
  progress.forget();
  return read;
}

BuiltScene buildScene(const Scene& scene, vtkStructuredGrid* grid, const Extent& lie,
  bool addGround, Progress& progress)
{
  Builder builder(scene, grid, lie, progress);
  builder.lay(addGround);
  for (const Body& body : scene.bodies)
  {
    std::visit(builder, body);
  }
  for (const Medium& medium : scene.media)
  {
    std::visit(builder, medium);
  }
  return builder.finish();
}

BuiltScene buildScene(const Scene& scene, bool addGround, Progress& progress)
{
  Stopwatch clock;
  const SceneData data = scene.data.file.empty() ? SceneData() : readData(scene, progress);
  const double readSeconds = clock.lap();
  BuiltScene built = buildScene(scene, data.grid, data.lie, addGround, progress);
  built.readSeconds = readSeconds;
  return built;
}
}
