// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SceneKeys.h
 * @brief The one table of a scene file's keys: spelling, unit, range and meaning of each, and the value it fills.
 *
 * visitKeys(part, visitor) calls visitor(Key, value) for each key of a part of the scene. The parser reads through it, the
 * reference is printed from it.
 */
#ifndef SceneKeys_h
#define SceneKeys_h

#include "Scene.h"

#include <limits>

namespace nephoscope::program
{
struct Key
{
  const char* name;
  const char* unit;
  const char* meaning;
  const char* initial; ///< the default, in words
  double least = -std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::max();
  std::vector<std::string> choices = {};
};

template <class Visitor>
void visitKeys(Picture& picture, Visitor&& visit)
{
  visit(Key{ "size", "pixels", "width and height", "[1024, 768]", 1, LargestSide }, picture.size);
  visit(
    Key{ "exposure", "stops", "each stop doubles the brightness", "0", -30, 30 }, picture.exposure);
  visit(Key{ "samples", "1", "rays across and up each pixel, averaged; 1 leaves outlines jagged",
          "2", 1, 8 },
    picture.samples);
}

template <class Visitor>
void visitKeys(Quality& quality, Visitor&& visit)
{
  visit(
    Key{ "tolerance", "1", "largest error of a pixel's radiance; the cheapest methods within it",
      "none: the methods that bodies and media name", 1e-12, 1e3 },
    quality.tolerance);
  visit(Key{ "seconds", "s", "longest time of drawing, instead; the most exact methods within it",
          "none", 1e-6, 1e9 },
    quality.seconds);
}

template <class Visitor>
void visitKeys(Data& data, Visitor&& visit)
{
  visit(Key{ "file", "", "NetCDF file, relative to the scene file", "required" }, data.file);
  visit(Key{ "time", "", "ISO 8601 date, seconds on the file's time axis, or index from 0", "0" },
    data.time);
  visit(Key{ "geometry", "", "how the grid lies in the scene", "automatic", {}, {},
          { "automatic", "map", "globe", "local" } },
    data.geometry);
  visit(Key{ "exaggeration", "1", "factor on heights", "from the data's extent", 1e-3, 1e4 },
    data.exaggeration);
  visit(Key{ "variables", "", "the variable of a role, such as CloudFraction: CLDTOT",
          "found by standard name" },
    data.variables);
}

template <class Visitor>
void visitKeys(CameraView& camera, Visitor&& visit)
{
  visit(Key{ "longitude", "degrees", "globe: meridian under the eye", "from the data", -360, 360 },
    camera.longitude);
  visit(Key{ "latitude", "degrees", "globe: parallel under the eye", "from the data", -90, 90 },
    camera.latitude);
  visit(Key{ "bearing", "degrees",
          "map, local: compass direction from the data's middle to the eye", "150", -360, 360 },
    camera.bearing);
  visit(
    Key{ "elevation", "degrees", "map, local: of the eye over the data's middle", "15", -90, 90 },
    camera.elevation);
  visit(
    Key{ "distance", "1",
      "globe: of the eye from the centre, planet radii; map, local: 1 is where all the data fit",
      "all fits", 1e-3, 1e6 },
    camera.distance);
  visit(Key{ "position", "scene units", "the eye, instead of the above", "from the above", -1e12,
          1e12 },
    camera.position);
  visit(Key{ "target", "scene units", "point in the picture's middle", "the data's middle", -1e12,
          1e12 },
    camera.target);
  visit(
    Key{ "up", "", "direction that points up in the picture", "[0, 0, 1]", -1e6, 1e6 }, camera.up);
  visit(Key{ "viewAngle", "degrees", "vertical angle of view", "30", 0.01, 170 }, camera.viewAngle);
  visit(Key{ "cylinder", "degrees",
          "draw on a cylinder about `up` round the eye, this wide, instead of viewAngle", "none",
          0.01, 360 },
    camera.cylinder);
}

template <class Visitor>
void visitKeys(Light& light, Visitor&& visit)
{
  visit(Key{ "towardSun", "", "direction to the sun in the scene", "over the eye's left shoulder",
          -1e6, 1e6 },
    light.towardSun);
  visit(
    Key{ "ambient", "1", "the sky's share of the light on surfaces", "0.3", 0, 1 }, light.ambient);
}

template <class Visitor>
void visitKeys(Animation& animation, Visitor&& visit)
{
  visit(Key{ "motion", "", "between keyframes: with a steady speed, or without a jerk", "smooth",
          {}, {}, { "smooth", "linear" } },
    animation.motion);
  visit(Key{ "restartPeriod", "hours",
          "textures that move begin anew so often and cross-fade; short bounds how far they are "
          "stretched, long lets them fade less",
          "until the wind has stretched them twofold", 0.1, 1e5 },
    animation.restartPeriod);
  visit(Key{ "cycle", "", "the frame after the last is the first: a film without end", "false" },
    animation.cycle);
}

template <class Visitor>
void visitKeys(Keyframe& frame, Visitor&& visit)
{
  visit(Key{ "at", "1", "moment: 0 is the first frame, 1 the last", "0", 0, 1 }, frame.at);
  visit(Key{ "longitude", "degrees", "as in camera", "runs on", -720, 720 }, frame.longitude);
  visit(Key{ "latitude", "degrees", "as in camera", "runs on", -90, 90 }, frame.latitude);
  visit(Key{ "bearing", "degrees", "as in camera", "runs on", -720, 720 }, frame.bearing);
  visit(Key{ "elevation", "degrees", "as in camera", "runs on", -90, 90 }, frame.elevation);
  visit(Key{ "distance", "1", "as in camera", "runs on", 1e-3, 1e6 }, frame.distance);
  visit(Key{ "viewAngle", "degrees", "as in camera", "runs on", 0.01, 170 }, frame.viewAngle);
  visit(Key{ "position", "scene units", "as in camera", "runs on" }, frame.position);
  visit(Key{ "target", "scene units", "as in camera", "runs on" }, frame.target);
  visit(Key{ "towardSun", "", "as in light", "runs on" }, frame.towardSun);
}

template <class Visitor>
void visitKeys(Backdrop& backdrop, Visitor&& visit)
{
  visit(Key{ "zenith", "linear RGB", "radiance overhead", "by geometry", 0, 1e6 }, backdrop.zenith);
  visit(Key{ "horizon", "linear RGB", "radiance at the horizon", "by geometry", 0, 1e6 },
    backdrop.horizon);
  visit(Key{ "nadir", "linear RGB", "radiance below", "by geometry", 0, 1e6 }, backdrop.nadir);
}

template <class Visitor>
void visitKeys(SurfaceBody& body, Visitor&& visit)
{
  visit(Key{ "value", "1", "cloud fraction of the surface", "0.15", 0, 1 }, body.value);
  visit(Key{ "smoothing", "grid steps",
          "standard deviation of the filter before contouring; 0 for none", "1", 0, 100 },
    body.smoothing);
  visit(Key{ "opacity", "1", "largest opacity", "1", 0, 1 }, body.opacity);
  visit(Key{ "color", "linear RGB", "reflectance", "[1, 1, 1]", 0, 1 }, body.color);
}

template <class Visitor>
void visitKeys(TextureBody& body, Visitor&& visit)
{
  visitKeys(static_cast<SurfaceBody&>(body), visit);
  visit(Key{ "wavelength", "km", "longest wave of the texture",
          "4 grid steps; on a whole globe a quarter of its radius", 1e-3, 1e5 },
    body.wavelength);
  visit(Key{ "octaves", "1", "number of waves, each half as long as the last", "7", 1, 8 },
    body.octaves);
  visit(Key{ "offset", "1", "T0: large fills the gaps", "0.6", 0, 10 }, body.offset);
  visit(
    Key{ "threshold", "1", "T1: the texture below it is clear", "0.15", -1, 1 }, body.threshold);
  visit(
    Key{ "rimThreshold", "1", "T2: takes the threshold's place towards the outline, and frays it",
      "0.2; on a map the threshold", -1, 1 },
    body.rimThreshold);
  visit(
    Key{ "range", "1", "D: from clear to opaque; large is soft", "0.35", 1e-6, 10 }, body.range);
  visit(
    Key{ "seed", "", "makes textures with equal parameters different", "1", 0, 1e9 }, body.seed);
  visit(Key{ "advect", "", "in an animation, carried by the data's wind", "true" }, body.advect);
}

template <class Visitor>
void visitKeys(VolumeBody& body, Visitor&& visit)
{
  visit(Key{ "quantity", "", "what makes the cloud dense", "fraction if the file has it", {}, {},
          { "automatic", "fraction", "condensate" } },
    body.quantity);
  visit(Key{ "extinction", "1/km", "of a cloud fraction of 1", "0.15", 0, 1e6 }, body.extinction);
  visit(Key{ "scale", "1", "factor on the extinction; 1 is the physical one",
          "1, of condensate 0.05", 0, 1e6 },
    body.scale);
  visit(
    Key{ "liquidRadius", "um", "effective radius of droplets", "10", 0.1, 1e4 }, body.liquidRadius);
  visit(
    Key{ "iceRadius", "um", "effective radius of ice crystals", "30", 0.1, 1e4 }, body.iceRadius);
  visit(
    Key{ "sunlit", "",
      "on a globe: bright by day and dim by night; false: aglow alike everywhere, as in Max 1994",
      "true" },
    body.sunlit);
  visit(Key{ "color", "linear RGB", "radiance of cloud that nothing shines through", "[1, 1, 1]", 0,
          1e6 },
    body.color);
  visit(
    Key{ "order", "",
      "cells sorted in each pixel, which is exact, all at once by what hides what, or by centroids",
      "pixelDepth", {}, {}, { "pixelDepth", "visibility", "centroid" } },
    body.order);
}

template <class Visitor>
void visitKeys(Ground& ground, Visitor&& visit)
{
  visit(
    Key{ "seaColor", "linear RGB", "reflectance", "[0.014, 0.042, 0.1]", 0, 1 }, ground.seaColor);
  visit(
    Key{ "landColor", "linear RGB", "reflectance", "[0.13, 0.12, 0.065]", 0, 1 }, ground.landColor);
  visit(Key{ "graticule", "degrees", "meridians and parallels at multiples of this; 0 for none",
          "0", 0, 90 },
    ground.graticule);
}

template <class Visitor>
void visitKeys(GlobeBody& body, Visitor&& visit)
{
  visitKeys(static_cast<Ground&>(body), visit);
}

template <class Visitor>
void visitKeys(PlaneBody& body, Visitor&& visit)
{
  visitKeys(static_cast<Ground&>(body), visit);
  visit(Key{ "height", "m", "above sea level", "0", -1e5, 1e5 }, body.height);
}

template <class Visitor>
void visitKeys(TerrainBody& body, Visitor&& visit)
{
  visit(Key{ "extent", "km", "width of the square that has ground", "30", 0.01, 1e4 }, body.extent);
  visit(Key{ "spacing", "m", "distance of the grid's points", "30", 0.01, 1e5 }, body.spacing);
  visit(Key{ "center", "m", "the square's middle; its z raises the hills", "[0, 0, 0]", -1e7, 1e7 },
    body.center);
  visit(Key{ "wavelength", "km", "of the largest hills", "12", 1e-3, 1e4 }, body.wavelength);
  visit(Key{ "relief", "m", "heights lie within about half of it from the mean", "1800", 0, 1e5 },
    body.relief);
  visit(Key{ "mean", "m", "mean height; below 0 the sea drowns more land", "60", -1e5, 1e5 },
    body.mean);
  visit(
    Key{ "gain", "1", "roughness: amplitude of each octave over that of the last", "0.5", 0, 1 },
    body.gain);
  visit(Key{ "seed", "", "makes hills with equal parameters different", "1", 0, 1e9 }, body.seed);
}

template <class Visitor>
void visitKeys(WaterBody& body, Visitor&& visit)
{
  visit(Key{ "level", "m", "of the water", "0", -1e5, 1e5 }, body.level);
  visit(
    Key{ "wind", "m/s", "over the water; makes it rough; 0: a calm, without waves", "5", 0, 30 },
    body.wind);
  visit(Key{ "direction", "degrees", "compass direction where the wind blows to", "70", -360, 360 },
    body.direction);
  visit(Key{ "wavelength", "m", "longest wave", "40", 0.1, 1000 }, body.wavelength);
  visit(Key{ "duration", "s", "of an animation, for the waves; 0: they stand still", "0", 0, 1e6 },
    body.duration);
  visit(
    Key{ "color", "linear RGB", "reflectance of the water's depth", "[0.008, 0.03, 0.04]", 0, 1 },
    body.color);
}

template <class Visitor>
void visitKeys(HeightFieldBody& body, Visitor&& visit)
{
  visit(
    Key{ "height", "m", "of the cloud plane, on which the clouds' edges lie", "1000", -1e5, 1e5 },
    body.height);
  visit(Key{ "cover", "1", "share of the sky", "0.4", 0, 1 }, body.cover);
  visit(Key{ "wavelength", "m", "of the longest wave: distance of the clouds", "1500", 1, 1e6 },
    body.wavelength);
  visit(Key{ "relief", "m", "amplitude of the longest wave", "160", 0, 1e5 }, body.relief);
  visit(Key{ "roundness", "m", "c: radius of the clouds' edges", "30", 0, 1e5 }, body.roundness);
  visit(Key{ "baseDepth", "m", "D: how far bottoms reach below the plane", "80", 1e-3, 1e5 },
    body.baseDepth);
  visit(Key{ "waves", "1", "number of waves", "12", 1, 64 }, body.waves);
  visit(
    Key{ "billows", "1", "how many of the shortest waves are billows with creases", "7", 0, 64 },
    body.billows);
  visit(Key{ "shortening", "1", "length of each wave over that of the last", "0.72", 0.01, 1 },
    body.shortening);
  visit(Key{ "smoothness", "1", "amplitudes are as the lengths to this power", "1", 0, 10 },
    body.smoothness);
  visit(Key{ "seed", "", "makes clouds with equal parameters different", "1", 0, 1e9 }, body.seed);
  visit(Key{ "extinction", "1/km", "of sunlight, of light to the eye, and of what lies behind",
          "[9.3, 16.3, 19.8]", 0, 1e9 },
    body.extinction);
  visit(Key{ "asymmetry", "1", "mean cosine of the scattering angle", "0", -0.95, 0.95 },
    body.asymmetry);
  visit(Key{ "far", "km", "distance where clouds end", "50", 0.01, 1e4 }, body.far);
  visit(Key{ "shadows", "km",
          "width of the square about the eye in which shadows are drawn; beyond it is their mean",
          "40", 1, 1e3 },
    body.shadows);
  visit(
    Key{ "sunlight", "1", "factor on the sun's light in the clouds", "1", 0, 1e3 }, body.sunlight);
  visit(Key{ "travel", "m", "in an animation, the way of the waves from its beginning to its end",
          "[0, 0]", -1e7, 1e7 },
    body.travel);
  visit(Key{ "method", "", "of the scattering; Moments is fast, Exact the reference", "Moments", {},
          {}, { "Moments", "Exact", "March", "Sexp1986" } },
    body.method);
  visit(Key{ "calibration", "",
          "constants of Sexp1986: none, for those of 1986; shipped; or a file of fit heightfield, "
          "relative to the scene file",
          "none" },
    body.calibration);
}

template <class Visitor>
void visitKeys(VoxelBody& body, Visitor&& visit)
{
  visit(Key{ "file", "", "OpenVDB file, relative to the scene file", "required" }, body.file);
  visit(Key{ "grid", "", "its fog volume or level set", "density" }, body.grid);
  visit(Key{ "extinction", "1/(scene unit)", "extinction where the grid has 1", "1", 0, 1e9 },
    body.extinction);
  visit(
    Key{ "albedo", "1", "share of it that is scattered, not absorbed", "1", 0, 1 }, body.albedo);
  visit(Key{ "asymmetry", "1", "mean cosine of the scattering angle", "0", -0.95, 0.95 },
    body.asymmetry);
  visit(Key{ "sunlight", "1", "factor on the sun's light in it", "1", 0, 1e3 }, body.sunlight);
}

template <class Visitor>
void visitKeys(UniformMedium& medium, Visitor&& visit)
{
  visit(Key{ "extinction", "1/km", "optical depth of a kilometre of the scene", "0", 0, 1e6 },
    medium.extinction);
  visit(Key{ "color", "linear RGB", "radiance of an endless depth of it", "[0.7, 0.8, 1]", 0, 1e6 },
    medium.color);
}

template <class Visitor>
void visitKeys(HazeMedium& medium, Visitor&& visit)
{
  visit(
    Key{ "extinction", "1/km, RGB", "optical depth of a kilometre; larger in blue as in dry air",
      "[0.03, 0.04, 0.06]", 0, 1e6 },
    medium.extinction);
  visit(Key{ "albedo", "1", "share of it that is scattered, not absorbed", "0.95", 0, 1 },
    medium.albedo);
  visit(Key{ "anisotropy", "1", "mean cosine of scattering; above 0 it is brightest about the sun",
          "0.6", -0.99, 0.99 },
    medium.anisotropy);
  visit(Key{ "sunlight", "1", "factor on the sun's light in it", "1", 0, 1e3 }, medium.sunlight);
  visit(Key{ "sky", "linear RGB", "radiance of an endless depth of it without the sun",
          "[0.1, 0.12, 0.15]", 0, 1e6 },
    medium.sky);
  visit(
    Key{ "height", "m", "its top, where there are no height-field clouds whose plane is the top",
      "2000", -1e5, 1e6 },
    medium.height);
  visit(Key{ "method", "", "how the light along a ray is summed", "moments", {}, {},
          { "exact", "march", "moments" } },
    medium.method);
  visit(Key{ "step", "m", "of march", "20", 1e-3, 1e6 }, medium.step);
}

/// The types of a body or a medium by the name that a file's key "type" gives them.
template <class Visitor>
void visitTypes(Body*, Visitor&& visit)
{
  visit("surface", "smoothly shaded surface of one cloud fraction", SurfaceBody());
  visit("texture", "such a surface with a transparency texture", TextureBody());
  visit("volume", "grid cells as volumes", VolumeBody());
  visit("globe", "the planet, opaque", GlobeBody());
  visit("plane", "flat ground or sea, opaque", PlaneBody());
  visit(
    "terrain", "made-up hills, opaque, in the shadow of the height-field clouds", TerrainBody());
  visit("water", "sea with waves that mirror sky, sun, clouds and hills, opaque", WaterBody());
  visit("heightField", "clouds between two height functions, lit from above", HeightFieldBody());
  visit("voxelVolume", "sparse voxels of an OpenVDB file, in sunlight scattered once", VoxelBody());
}

template <class Visitor>
void visitTypes(Medium*, Visitor&& visit)
{
  visit("uniform", "haze of one density everywhere", UniformMedium());
  visit("haze", "haze under the clouds, with shafts of sunlight through their gaps", HazeMedium());
}

/// The sections of a scene file: mappings first, then the lists of typed parts.
template <class Mapping, class List>
void visitSections(Scene& scene, Mapping&& mapping, List&& list)
{
  mapping("picture", scene.picture);
  mapping("quality", scene.quality);
  mapping("data", scene.data);
  mapping("camera", scene.camera);
  mapping("light", scene.light);
  mapping("backdrop", scene.backdrop);
  mapping("animation", scene.animation);
  list("keyframes", scene.keyframes);
  list("bodies", scene.bodies);
  list("media", scene.media);
}
}
#endif
