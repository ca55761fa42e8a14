// SPDX-License-Identifier: BSD-3-Clause
// A scene file's keys reach the scene; whatever is wrong with a file is said with its name, its line and the remedy.
#include "Failure.h"
#include "SceneFile.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

using namespace nephoscope::program;

namespace
{
std::string failureOf(const std::string& text)
{
  try
  {
    parseScene(text, "folder/scene.yaml");
  }
  catch (const UsageFailure& failure)
  {
    EXPECT_EQ(std::string(failure.what()).find('\n'), std::string::npos) << "more than one line";
    return failure.what();
  }
  return "no failure";
}

const char* const Whole = R"(
picture: { size: [640, 360], exposure: -1.5 }
data:
  file: ../data/a.nc
  time: 2001-10-01T06
  geometry: globe
  exaggeration: 25
  variables: { CloudFraction: CLDTOT, Pressure: p }
camera: { longitude: -40, latitude: 25, distance: 3, viewAngle: 20, up: [0, 0, 1] }
light: { towardSun: [1, -1, 0.5] }
backdrop: { zenith: [0.1, 0.2, 0.4] }
bodies:
  - { type: globe, seaColor: [0, 0, 0.1] }
  - { type: texture, value: 0.3, wavelength: 900, smoothing: 2 }
  - type: volume
    quantity: condensate
    order: visibility
media:
  - { type: uniform, extinction: 0.001 }
)";
}

TEST(SceneFile, FillsEveryPart)
{
  const Scene scene = parseScene(Whole, "folder/scene.yaml");
  EXPECT_EQ(scene.picture.size, (std::array<int, 2>{ 640, 360 }));
  EXPECT_EQ(scene.picture.exposure, -1.5);
  EXPECT_EQ(scene.data.file, "data/a.nc") << "relative to the scene file";
  EXPECT_EQ(scene.data.time, "2001-10-01T06");
  EXPECT_EQ(scene.data.geometry, "globe");
  EXPECT_EQ(scene.data.exaggeration, 25);
  EXPECT_EQ(scene.data.variables.at("CloudFraction"), "CLDTOT");
  EXPECT_EQ(scene.data.variables.size(), 2u);
  EXPECT_EQ(scene.camera.longitude, -40);
  EXPECT_EQ(scene.camera.viewAngle, 20);
  EXPECT_FALSE(scene.camera.position);
  EXPECT_EQ(scene.light.towardSun, (Triple{ 1, -1, 0.5 }));
  EXPECT_EQ(scene.backdrop.zenith, (Triple{ 0.1, 0.2, 0.4 }));
  EXPECT_FALSE(scene.backdrop.nadir);
  ASSERT_EQ(scene.bodies.size(), 3u);
  EXPECT_EQ(std::get<GlobeBody>(scene.bodies[0]).seaColor, (Triple{ 0, 0, 0.1 }));
  EXPECT_EQ(std::get<TextureBody>(scene.bodies[1]).value, 0.3);
  EXPECT_EQ(std::get<TextureBody>(scene.bodies[1]).wavelength, 900);
  EXPECT_EQ(std::get<VolumeBody>(scene.bodies[2]).quantity, "condensate");
  EXPECT_EQ(std::get<VolumeBody>(scene.bodies[2]).order, "visibility");
  EXPECT_EQ(VolumeBody().order, "pixelDepth");
  ASSERT_EQ(scene.media.size(), 1u);
  EXPECT_EQ(std::get<UniformMedium>(scene.media[0]).extinction, 0.001);
}

TEST(SceneFile, AbsolutePathsStay)
{
  EXPECT_EQ(
    parseScene("data: { file: /a/b.nc }\nbodies: [{ type: surface }]", "folder/s.yaml").data.file,
    "/a/b.nc");
}

TEST(SceneFile, UnknownKeysSuggestTheNearest)
{
  EXPECT_EQ(failureOf("picture:\n  exposur: 1\n"),
    "folder/scene.yaml:2: unknown key 'exposur' in 'picture'; did you mean 'exposure'?");
  EXPECT_EQ(failureOf("data: { file: a }\n\ncamra: {}\n"),
    "folder/scene.yaml:3: unknown key 'camra' in 'scene'; did you mean 'camera'?");
  EXPECT_EQ(failureOf("bodies:\n  - type: texture\n    valve: 1\n"),
    "folder/scene.yaml:3: unknown key 'valve' in 'texture'; did you mean 'value'?");
  EXPECT_EQ(failureOf("bodies:\n  - type: volum\n"),
    "folder/scene.yaml:2: 'type' cannot be 'volum'; did you mean 'volume'?");
  EXPECT_EQ(failureOf("data: { geometry: glob }"),
    "folder/scene.yaml:1: 'geometry' cannot be 'glob'; did you mean 'globe'?");
}

TEST(SceneFile, WrongTypesSayWhatIsRight)
{
  EXPECT_EQ(failureOf("picture: { exposure: bright }"),
    "folder/scene.yaml:1: 'exposure' must be a number, in stops");
  EXPECT_EQ(failureOf("bodies: [{ type: surface, value: much }]"),
    "folder/scene.yaml:1: 'value' must be a number");
  EXPECT_EQ(failureOf("picture: { exposure: .nan }"),
    "folder/scene.yaml:1: 'exposure' must be a number, in stops");
  EXPECT_EQ(failureOf("picture: { size: 640 }"),
    "folder/scene.yaml:1: 'size' must be a list of 2 numbers, in pixels");
  EXPECT_EQ(failureOf("picture: { size: [640, 2.5] }"),
    "folder/scene.yaml:1: 'size' must be a whole number");
  EXPECT_EQ(failureOf("picture: { size: [640, 1e9] }"),
    "folder/scene.yaml:1: 'size' is 1e+09; it must be from 1 to 32768");
  EXPECT_EQ(failureOf("data: { variables: cl }"),
    "folder/scene.yaml:1: 'variables' must be a mapping, ROLE: NAME");
  EXPECT_EQ(failureOf("camera: 3"), "folder/scene.yaml:1: 'camera' must be a mapping, key: value");
  EXPECT_EQ(failureOf("bodies: { type: volume }"),
    "folder/scene.yaml:1: 'bodies' must be a list, each part beginning with '- type: '");
  EXPECT_EQ(failureOf("bodies: [{ value: 0.1 }]"),
    "folder/scene.yaml:1: a part of 'bodies' has no 'type'; give one, such as type: surface");
  EXPECT_EQ(failureOf("bodies: [{ type: surface, value: 1.5 }]"),
    "folder/scene.yaml:1: 'value' is 1.5; it must be from 0 to 1");
}

TEST(SceneFile, MalformedFilesAreRefused)
{
  EXPECT_EQ(failureOf(""), "folder/scene.yaml: 'scene' must be a mapping, key: value");
  EXPECT_EQ(failureOf("- 1\n- 2"), "folder/scene.yaml:1: 'scene' must be a mapping, key: value");
  EXPECT_EQ(failureOf("picture: {\n  size: [1,"),
    "folder/scene.yaml:2: is not YAML: end of sequence flow not found");
  EXPECT_EQ(failureOf("picture: { exposure: 1 }\npicture: { exposure: 2 }"),
    "folder/scene.yaml:2: the key 'picture' stands twice in 'scene'");
  EXPECT_EQ(failureOf("? [1, 2]\n: 3"), "folder/scene.yaml:1: a key of 'scene' must be a word");
  EXPECT_EQ(failureOf("picture: {}"),
    "folder/scene.yaml: there is nothing to draw; add bodies: [{ type: volume }]");
  EXPECT_EQ(failureOf("bodies: [{ type: volume }]"),
    "folder/scene.yaml: the bodies need data; add data: { file: NAME.nc }");
  EXPECT_NE(failureOf(std::string(100000, '[')), "no failure") << "deep nesting";
}

TEST(SceneFile, MissingFileIsNamed)
{
  EXPECT_THROW(
    {
      try
      {
        readScene("nowhere.yaml");
      }
      catch (const Failure& failure)
      {
        EXPECT_STREQ(failure.what(), "nowhere.yaml: there is no such scene file");
        EXPECT_EQ(failure.code(), RunTimeError);
        throw;
      }
    },
    Failure);
}

TEST(SceneFile, TheReferenceIsTheProgramsOwn)
{
  std::ifstream stream(NEPHOSCOPE_SOURCE_DIR "/Utilities/Doc/scene.md");
  std::ostringstream document;
  document << stream.rdbuf();
  EXPECT_NE(document.str().find(sceneReference()), std::string::npos)
    << "bring Utilities/Doc/scene.md up to date with: nephoscope render --scene-keys";
}

TEST(SceneFile, AGlobeNeedsData)
{
  EXPECT_NE(failureOf("bodies: [{ type: globe }]").find("scene.yaml: the bodies need data"),
    std::string::npos);
}

TEST(SceneFile, DirectionsHaveADirection)
{
  const std::string rest = "\ndata: { file: a.nc }\nbodies: [{ type: volume }]";
  EXPECT_NE(
    failureOf("camera: { up: [0, 0, 0] }" + rest).find("'up' is [0, 0, 0]"), std::string::npos);
  EXPECT_NE(failureOf("light: { towardSun: [0, 0, 0] }" + rest).find("'towardSun' is [0, 0, 0]"),
    std::string::npos);
}

TEST(SceneFile, LengthsAndRadiancesStayWhereTheirSquaresAreFinite)
{
  EXPECT_NE(failureOf("camera: { position: [1e300, 0, 0] }").find("from -1e+12 to 1e+12"),
    std::string::npos);
  EXPECT_NE(
    failureOf("backdrop: { zenith: [1e308, 0, 0] }").find("from 0 to 1e+06"), std::string::npos);
}

TEST(SceneFile, NonsenseInLandscapesIsRefused)
{
  const std::pair<const char*, const char*> wrong[] = {
    { "media: [{ type: haze, extinction: [-1, 0, 0] }]",
      "'extinction' is -1; it must be from 0 to 1e+06" },
    { "media: [{ type: haze, extinction: [.nan, 0, 0] }]",
      "'extinction' must be a number, in 1/km, RGB" },
    { "media: [{ type: haze, step: 0 }]", "'step' is 0; it must be from 0.001 to 1e+06" },
    { "media: [{ type: haze, anisotropy: 1 }]",
      "'anisotropy' is 1; it must be from -0.99 to 0.99" },
    { "media: [{ type: haze, method: fast }]",
      "'method' cannot be 'fast'; it can be exact, march, moments" },
    { "bodies: [{ type: terrain, extent: 0 }]", "'extent' is 0; it must be from 0.01 to 10000" },
    { "bodies: [{ type: terrain, relief: .inf }]", "'relief' must be a number, in m" },
    { "bodies: [{ type: water, wavelength: 0 }]",
      "'wavelength' is 0; it must be from 0.1 to 1000" },
    { "bodies: [{ type: heightField, waves: 1e9 }]", "'waves' is 1e+09; it must be from 1 to 64" },
    { "bodies: [{ type: heightField, cover: 2 }]", "'cover' is 2; it must be from 0 to 1" },
    { "bodies: [{ type: heightField, wavelength: 0 }]",
      "'wavelength' is 0; it must be from 1 to 1e+06" },
  };
  for (const auto& [scene, message] : wrong)
  {
    EXPECT_EQ(failureOf(scene), std::string("folder/scene.yaml:1: ") + message);
  }
  EXPECT_EQ(failureOf("bodies:\n- { type: water }\n- { type: terrain, extent: 491.55 }"),
    "folder/scene.yaml:3: terrain of 'extent' 491.55 km at 'spacing' 30 m is 16386 points wide; at "
    "most 16384: give a smaller extent or a larger spacing");
  EXPECT_EQ(parseScene("bodies: [{ type: terrain, extent: 491.4 }]\ncamera: { position: [0, 0, 9], "
                       "target: [0, 9, 9] }",
              "x")
              .bodies.size(),
    1U);
}

TEST(SceneFile, IsOneDocumentWithMappingsAsParts)
{
  EXPECT_NE(failureOf("a: 1\n---\nb: 2\n").find("holds 2 YAML documents"), std::string::npos);
  EXPECT_NE(failureOf("bodies: [surface]").find(":1: a part of 'bodies' must be a mapping"),
    std::string::npos);
}

TEST(SceneFile, WithoutDataNeedsAView)
{
  const std::string plane = "bodies: [{ type: plane }]\n";
  EXPECT_NE(failureOf(plane).find("give camera: { position: [X, Y, Z], target: [X, Y, Z] }"),
    std::string::npos);
  const Scene scene = parseScene(
    plane + "camera: { position: [0, 0, 9], target: [0, 5, 9], cylinder: 180 }\n", "scene.yaml");
  EXPECT_TRUE(scene.data.file.empty());
  EXPECT_EQ(scene.camera.cylinder, 180);
  EXPECT_FALSE(scene.camera.position == scene.camera.target);
}
