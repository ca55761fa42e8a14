// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudHeightField.h"

#include "Camera.h"
#include "CloudArrays.h"
#include "CloudPanorama.h"
#include "Cumulus.h"
#include "DeepTile.h"
#include "Exponential.h"
#include "HeightFieldScattering.h"
#include "SliceFan.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkCloudHeightField);

namespace
{
/// A segment as it waits for its tile; distances are horizontal.
struct Waiting
{
  double NearEnd;
  double FarEnd;
  float Light;
  float Behind; ///< optical depth for what lies behind
};

/// 4 pi times the phase function of Henyey and Greenstein 1941; cosine 1 is straight on.
double phase(double asymmetry, double cosine)
{
  const double g = asymmetry;
  const double base = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (base * std::sqrt(base));
}
}

/// What Prepare leaves for Emit.
struct vtkCloudHeightField::Drawn
{
  nephoscope::HeightFieldShape Shape;
  double PlaneHeight = 0;
  std::unique_ptr<nephoscope::SliceFan> Fan;
  std::unique_ptr<nephoscope::HeightFieldScattering> Parts; ///< for segments that are cut short
  std::vector<std::vector<Waiting>> Segments;               ///< of each slice, sorted by slot
  std::vector<std::uint32_t> Starts; ///< of each slot in its slice's segments; and one a slice
  double FarDistance = 0;
  double Growth = 0;

  nephoscope::CloudSlice Slice(std::size_t s) const
  {
    const nephoscope::PixelSlice& slice = this->Fan->slice(s);
    return { slice.eye[0], slice.eye[1], slice.eye[2], slice.ux, slice.uy, this->FarDistance,
      this->Growth };
  }
};

/// Works slices out; each thread has a method of its own.
class vtkCloudHeightField::SliceWorker
{
public:
  SliceWorker(Drawn& drawn, std::string method, const nephoscope::ScatteringDensities& densities,
    const nephoscope::ScatteringSettings& settings)
    : Ready(drawn)
    , Method(std::move(method))
    , Densities(densities)
    , Settings(settings)
  {
  }

  void Initialize()
  {
    this->Locals.Local().Scattering = nephoscope::HeightFieldScattering::make(this->Method,
      nephoscope::HeightField(this->Ready.Shape), this->Ready.PlaneHeight, this->Densities,
      this->Settings);
  }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    Local& local = this->Locals.Local();
    for (vtkIdType s = begin; s < end; ++s)
    {
      this->Work(static_cast<std::size_t>(s), local);
    }
  }

  void Reduce()
  {
    for (const Local& local : this->Locals)
    {
      this->LargestView = std::max(this->LargestView, local.LargestView);
      this->LargestSun = std::max(this->LargestSun, local.LargestSun);
    }
  }

  double LargestView = 0;
  double LargestSun = 0;

private:
  struct Local
  {
    std::shared_ptr<nephoscope::HeightFieldScattering>
      Scattering; // vtkSMPThreadLocal copies the empty one
    nephoscope::SliceLight Light;
    std::vector<double> Slopes;
    std::vector<std::uint32_t> Next;
    double LargestView = 0;
    double LargestSun = 0;
  };

  void Work(std::size_t s, Local& local)
  {
    const nephoscope::SliceFan& fan = *this->Ready.Fan;
    const std::size_t first = fan.slice(s).first;
    const std::size_t last = fan.end(s);
    local.Slopes.clear();
    for (std::size_t slot = first; slot < last; ++slot)
    {
      local.Slopes.push_back(fan.slope(slot));
    }
    local.Scattering->shine(this->Ready.Slice(s), local.Slopes, local.Light);
    local.LargestView = std::max(local.LargestView, local.Light.largestViewArgument);
    local.LargestSun = std::max(local.LargestSun, local.Light.largestSunArgument);

    // Sorted by slot, those of a slot as they came.
    std::vector<std::uint32_t>& next = local.Next;
    next.assign(last - first + 1, 0);
    for (const nephoscope::HeightFieldSegment& segment : local.Light.segments)
    {
      ++next[segment.ray + 1];
    }
    for (std::size_t i = 1; i < next.size(); ++i)
    {
      next[i] += next[i - 1];
    }
    std::copy(next.begin(), next.end(),
      this->Ready.Starts.begin() + static_cast<std::ptrdiff_t>(first + s));
    std::vector<Waiting>& waiting = this->Ready.Segments[s];
    waiting.resize(local.Light.segments.size());
    for (const nephoscope::HeightFieldSegment& segment : local.Light.segments)
    {
      waiting[next[segment.ray]++] = { segment.nearEnd, segment.farEnd,
        static_cast<float>(segment.light), static_cast<float>(segment.opticalDepth) };
    }
  }

  Drawn& Ready;
  std::string Method;
  nephoscope::ScatteringDensities Densities;
  nephoscope::ScatteringSettings Settings;
  vtkSMPThreadLocal<Local> Locals;
};

vtkCloudHeightField::vtkCloudHeightField()
  : Ready(std::make_unique<Drawn>())
{
}

vtkCloudHeightField::~vtkCloudHeightField() = default;

int vtkCloudHeightField::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

bool vtkCloudHeightField::ReadField()
{
  vtkDataObject* const data = this->GetInputDataObject(0, 0);
  auto* const numbers = data ? vtkDoubleArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(
                                 nephoscope::arrays::HeightField))
                             : nullptr;
  if (!numbers ||
    !nephoscope::shapeOf(numbers->GetPointer(0),
      static_cast<std::size_t>(numbers->GetNumberOfValues()), this->Ready->Shape,
      this->Ready->PlaneHeight))
  {
    vtkErrorMacro("The input has no field data array " << nephoscope::arrays::HeightField
                                                       << " of a height field; connect a "
                                                          "vtkCloudHeightFieldSource.");
    return false;
  }
  return true;
}

bool vtkCloudHeightField::Prepare(const nephoscope::Camera& camera)
{
  const std::vector<std::string>& names = nephoscope::HeightFieldScattering::names();
  if (std::find(names.begin(), names.end(), this->Method) == names.end())
  {
    vtkErrorMacro(
      "Method '" << this->Method << "' is none: use Exact, March, Sexp1986 or Moments.");
    return false;
  }
  if (!(this->FarDistance > 0) || !(this->Step > 0))
  {
    vtkErrorMacro(
      "FarDistance " << this->FarDistance << " and Step " << this->Step << " have to be above 0.");
    return false;
  }
  if (!(this->SunFactor > 0) || !(this->ViewFactor > 0) || !(this->Gain > 0))
  {
    vtkErrorMacro("SunFactor " << this->SunFactor << ", ViewFactor " << this->ViewFactor
                               << " and Gain " << this->Gain << " have to be above 0.");
    return false;
  }
  if (!this->ReadField())
  {
    return false;
  }
  Drawn& drawn = *this->Ready;
  drawn.Fan = std::make_unique<nephoscope::SliceFan>(camera, this->SliceSpacing);
  drawn.FarDistance = this->FarDistance;
  // Half a pixel with the default of samples.
  drawn.Growth = camera.isParallel() ? 0 : camera.pixel() * 12 / this->SamplesPerWave;
  drawn.Segments.assign(drawn.Fan->numberOfSlices(), {});
  drawn.Starts.assign(drawn.Fan->numberOfSlots() + drawn.Fan->numberOfSlices(), 0);
  const nephoscope::ScatteringDensities densities{ this->SunExtinction, this->ViewExtinction,
    this->BackgroundExtinction };
  nephoscope::ScatteringSettings settings;
  settings.step = this->Step;
  settings.sunFactor = this->SunFactor;
  settings.viewFactor = this->ViewFactor;
  settings.gain = this->Gain;
  settings.samplesPerWave = this->SamplesPerWave;
  drawn.Parts = nephoscope::HeightFieldScattering::make(
    "Moments", nephoscope::HeightField(drawn.Shape), drawn.PlaneHeight, densities, settings);
  SliceWorker worker(drawn, this->Method, densities, settings);
  vtkSMPTools::For(0, static_cast<vtkIdType>(drawn.Fan->numberOfSlices()), worker);
  this->LargestViewArgument = worker.LargestView;
  this->LargestSunArgument = worker.LargestSun;
  return true;
}

void vtkCloudHeightField::Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  const nephoscope::TileExtent& e = tile.extent();
  const nephoscope::Vector3 sun = nephoscope::normalized(
    nephoscope::Vector3{ this->TowardSun[0], this->TowardSun[1], this->TowardSun[2] });
  for (int y = e.y0; y < e.y0 + e.height; ++y)
  {
    for (int x = e.x0; x < e.x0 + e.width; ++x)
    {
      const nephoscope::SliceFan::Place place = this->Ready->Fan->placeOf(x, y);
      const std::size_t at = place.slot + place.slice;
      if (this->Ready->Starts[at] == this->Ready->Starts[at + 1])
      {
        continue;
      }
      const double shine = this->Asymmetry == 0
        ? 1
        : phase(this->Asymmetry, dot(sun, camera.ray(x + 0.5, y + 0.5).direction));
      this->EmitPixel(x, y, place.slice, place.slot, shine, tile);
    }
  }
}

void vtkCloudHeightField::EmitPixel(
  int x, int y, std::size_t slice, std::size_t slot, double shine, nephoscope::DeepTile& tile) const
{
  const Drawn& drawn = *this->Ready;
  const double slope = drawn.Fan->slope(slot);
  const double gamma = std::sqrt(1 + slope * slope);
  const double hidden = tile.opaqueAt(x, y) / gamma;
  const std::uint32_t last = drawn.Starts[slot + slice + 1];
  for (std::uint32_t i = drawn.Starts[slot + slice]; i < last; ++i)
  {
    const Waiting& waiting = drawn.Segments[slice][i];
    if (waiting.NearEnd >= hidden)
    {
      return;
    }
    const double farEnd = std::min(waiting.FarEnd, hidden);
    const double share = (farEnd - waiting.NearEnd) / (waiting.FarEnd - waiting.NearEnd);
    const double light = share < 1
      ? drawn.Parts->part(drawn.Slice(slice), slope, waiting.NearEnd, farEnd)
      : waiting.Light;
    const double glow =
      1 - nephoscope::exponential(-this->ViewExtinction * gamma * (farEnd - waiting.NearEnd));
    nephoscope::Segment segment;
    segment.nearEnd = gamma * waiting.NearEnd;
    segment.farEnd = gamma * farEnd;
    for (int c = 0; c < 3; ++c)
    {
      segment.opticalDepth[c] = static_cast<float>(share * waiting.Behind);
      segment.radiance[c] =
        static_cast<float>(this->SunColor[c] * (1 - this->Ambient) * shine * light +
          this->SkyColor[c] * this->Ambient * glow);
    }
    tile.add(x, y, segment);
  }
}

bool vtkCloudHeightField::Survey(
  const nephoscope::Vector3& eye, nephoscope::CloudPanorama& panorama)
{
  if (!(this->FarDistance > 0) || !this->ReadField())
  {
    return false;
  }
  panorama =
    nephoscope::CloudPanorama(nephoscope::HeightField(this->Ready->Shape), this->Ready->PlaneHeight,
      { this->SunExtinction, this->ViewExtinction, this->BackgroundExtinction }, eye,
      this->FarDistance);
  return true;
}

nephoscope::Vector3 vtkCloudHeightField::RadianceOf(
  double light, double transmittance, const nephoscope::Vector3& direction) const
{
  const nephoscope::Vector3 sun = nephoscope::normalized(
    nephoscope::Vector3{ this->TowardSun[0], this->TowardSun[1], this->TowardSun[2] });
  const double shine = this->Asymmetry == 0 ? 1 : phase(this->Asymmetry, dot(sun, direction));
  // As of one stretch of cloud: 1 - exp(-view depth), from exp(-background depth).
  const double glow = transmittance < 1 && this->BackgroundExtinction > 0
    ? 1 - std::pow(std::max(transmittance, 0.0), this->ViewExtinction / this->BackgroundExtinction)
    : 0;
  nephoscope::Vector3 radiance{};
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] = this->SunColor[c] * (1 - this->Ambient) * shine * light +
      this->SkyColor[c] * this->Ambient * glow;
  }
  return radiance;
}

void vtkCloudHeightField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << '\n';
  os << indent << "SunExtinction: " << this->SunExtinction << '\n';
  os << indent << "ViewExtinction: " << this->ViewExtinction << '\n';
  os << indent << "BackgroundExtinction: " << this->BackgroundExtinction << '\n';
  os << indent << "Asymmetry: " << this->Asymmetry << '\n';
  os << indent << "FarDistance: " << this->FarDistance << '\n';
  os << indent << "Step: " << this->Step << '\n';
  os << indent << "SunFactor: " << this->SunFactor << '\n';
  os << indent << "ViewFactor: " << this->ViewFactor << '\n';
  os << indent << "Gain: " << this->Gain << '\n';
  os << indent << "SliceSpacing: " << this->SliceSpacing << '\n';
  os << indent << "SamplesPerWave: " << this->SamplesPerWave << '\n';
  os << indent << "LargestViewArgument: " << this->LargestViewArgument << '\n';
  os << indent << "LargestSunArgument: " << this->LargestSunArgument << '\n';
}
