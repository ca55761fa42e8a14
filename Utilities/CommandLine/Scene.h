// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Scene.h
 * @brief What a picture is made of, as a scene file or the command line says it.
 *
 * Plain values; SceneKeys.h says how a file spells them, with units and ranges. What is optional and not given is chosen
 * from the data when the scene is built.
 */
#ifndef Scene_h
#define Scene_h

#include <array>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace nephoscope::program
{
using Triple = std::array<double, 3>;

constexpr int LargestSide = 32768; ///< of a picture, pixels times samples: vtkCloudscape's

struct Picture
{
  std::array<int, 2> size{ 1024, 768 };
  double exposure = 0;
  int samples = 2;
};

/// What the methods of the picture are chosen for; one of both, or neither.
struct Quality
{
  std::optional<double> tolerance; ///< relative radiance
  std::optional<double> seconds;

  bool isAsked() const { return this->tolerance || this->seconds; }
};

struct Data
{
  std::string file;
  std::optional<std::string> time;
  std::string geometry = "automatic";
  std::optional<double> exaggeration;
  std::map<std::string, std::string> variables;
};

struct CameraView
{
  std::optional<double> longitude; ///< globe: over which the eye stands
  std::optional<double> latitude;
  std::optional<double> bearing; ///< map, local: from the data's middle to the eye
  std::optional<double> elevation;
  std::optional<double> distance;
  std::optional<Triple> position;
  std::optional<Triple> target;
  std::optional<Triple> up;
  double viewAngle = 30;
  std::optional<double> cylinder; ///< width of a cylindrical picture
};

/// What the camera and the sun are at one moment of an animation; what is not given runs on between its neighbours.
struct Keyframe
{
  double at = 0; ///< of the animation, 0 the first frame, 1 the last
  std::optional<double> longitude;
  std::optional<double> latitude;
  std::optional<double> bearing;
  std::optional<double> elevation;
  std::optional<double> distance;
  std::optional<double> viewAngle;
  std::optional<Triple> position;
  std::optional<Triple> target;
  std::optional<Triple> towardSun;
};

/// How keyframes are joined, and how long a moving texture lives.
struct Animation
{
  std::string motion = "smooth";
  std::optional<double> restartPeriod; ///< h
  bool cycle = false;                  ///< the frame after the last is the first
};

struct Light
{
  std::optional<Triple> towardSun;
  double ambient = 0.3;
};

struct Backdrop
{
  std::optional<Triple> zenith;
  std::optional<Triple> horizon;
  std::optional<Triple> nadir;
};

/// A smoothly shaded surface of one cloudiness: Max 1994, figure 5.
struct SurfaceBody
{
  double value = 0.15;
  double smoothing = 1;
  double opacity = 1;
  Triple color{ 1, 1, 1 };
};

/// The same with a transparency texture: Max 1994, figure 6.
struct TextureBody : SurfaceBody
{
  std::optional<double> wavelength;
  int octaves = 7;
  double offset = 0.6;
  double threshold = 0.15;
  std::optional<double> rimThreshold;
  double range = 0.35;
  int seed = 1;
  bool advect = true; ///< in an animation, with the wind
};

/// Grid cells as volumes: Max 1994, figure 7.
struct VolumeBody
{
  std::string quantity = "automatic";
  double extinction = 0.15;
  std::optional<double> scale;
  double liquidRadius = 10;
  double iceRadius = 30;
  bool sunlit = true;
  Triple color{ 1, 1, 1 };
  std::string order = "pixelDepth";
};

/// The planet's surface.
struct Ground
{
  Triple seaColor{ 0.014, 0.042, 0.1 };
  Triple landColor{ 0.13, 0.12, 0.065 };
  double graticule = 0;
};
struct GlobeBody : Ground
{
};
struct PlaneBody : Ground
{
  double height = 0;
};

/// Made-up hills.
struct TerrainBody
{
  double extent = 30;     ///< km
  double spacing = 30;    ///< m
  double wavelength = 12; ///< km
  double relief = 1800;   ///< m
  double mean = 60;       ///< m
  double gain = 0.5;
  Triple center{ 0, 0, 0 };
  int seed = 1;
};

/// A sea with waves.
struct WaterBody
{
  double level = 0;      ///< m
  double wind = 5;       ///< m/s
  double direction = 70; ///< degrees, where the wind blows to
  double wavelength = 40;
  double duration = 0; ///< s
  Triple color{ 0.008, 0.03, 0.04 };
};

/// Clouds between two height functions: Max 1986.
struct HeightFieldBody
{
  double height = 1000; ///< m
  double cover = 0.4;
  double wavelength = 1500; ///< m
  double relief = 160;      ///< m
  double roundness = 30;    ///< m
  double baseDepth = 80;    ///< m
  int waves = 12;
  int billows = 7;
  double shortening = 0.72;
  double smoothness = 1;
  int seed = 1;
  Triple extinction{ 9.3, 16.3, 19.8 }; ///< 1/km
  double asymmetry = 0;
  double far = 50;     ///< km
  double shadows = 40; ///< km
  double sunlight = 1;
  std::array<double, 2> travel{ 0, 0 }; ///< m
  std::string method = "Moments";
  std::string calibration = "none"; ///< none, shipped or a file
};

/// Sparse voxels of an OpenVDB file.
struct VoxelBody
{
  std::string file;
  std::string grid = "density";
  double extinction = 1; ///< 1/(scene unit) of a density of 1
  double albedo = 1;
  double asymmetry = 0;
  double sunlight = 1;
};

using Body = std::variant<SurfaceBody, TextureBody, VolumeBody, GlobeBody, PlaneBody, TerrainBody,
  WaterBody, HeightFieldBody, VoxelBody>;

/// Haze of one density everywhere.
struct UniformMedium
{
  double extinction = 0;
  Triple color{ 0.7, 0.8, 1 };
};

/// Haze under the clouds, with shafts of sunlight.
struct HazeMedium
{
  Triple extinction{ 0.03, 0.04, 0.06 };
  double albedo = 0.95;
  double anisotropy = 0.6;
  double sunlight = 1;
  Triple sky{ 0.1, 0.12, 0.15 };
  double height = 2000;
  std::string method = "moments";
  double step = 20;
};

using Medium = std::variant<UniformMedium, HazeMedium>;

struct Scene
{
  Picture picture;
  Quality quality;
  Data data;
  CameraView camera;
  Light light;
  Backdrop backdrop;
  Animation animation;
  std::vector<Keyframe> keyframes; ///< in rising order
  std::vector<Body> bodies;
  std::vector<Medium> media;
  double moment = 0; ///< of the animation, 0 to 1; not a key
  std::string file;  ///< that it was read from; not a key

  /// The file that an error is about.
  const std::string& subject() const
  {
    return this->data.file.empty() ? this->file : this->data.file;
  }
};

/// The scene of a style for a data file: surface, texture or volume, with ground under it.
Scene sceneOfStyle(const std::string& style, const std::string& dataFile);

/// Whether a body is made of the data of a file.
bool needsData(const Body& body);

/// @throw UsageFailure for what a scene cannot be, such as clouds of data without data
void validate(const Scene& scene, const std::string& name);
}
#endif
