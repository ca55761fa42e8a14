// SPDX-License-Identifier: BSD-3-Clause
#include "Keyframes.h"
#include "SceneFile.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace nephoscope::program;

namespace
{
Scene sceneOf(const std::string& motion)
{
  return parseScene("animation: { motion: " + motion + R"( }
data: { file: a.nc }
camera: { latitude: 7 }
keyframes:
  - { at: 0.2, longitude: 10, towardSun: [1, 0, 0] }
  - { at: 0.6, longitude: 50, distance: 3 }
  - { at: 1, longitude: 60, towardSun: [0, 2, 0] }
bodies: [ { type: globe } ]
)",
    "a.yaml");
}
}

TEST(Keyframes, LinearMotionGoesFromOneToTheNextAndStaysOutside)
{
  const Scene scene = sceneOf("linear");
  EXPECT_EQ(sceneAt(scene, 0).camera.longitude, 10);
  EXPECT_NEAR(*sceneAt(scene, 0.3).camera.longitude, 20, 1e-9);
  EXPECT_NEAR(*sceneAt(scene, 0.8).camera.longitude, 55, 1e-9);
  EXPECT_EQ(sceneAt(scene, 1).camera.longitude, 60);
  EXPECT_EQ(sceneAt(scene, 0.1).camera.distance, 3); // one keyframe gives it: always
  EXPECT_EQ(sceneAt(scene, 0.5).camera.latitude, 7); // none does: the scene's
}

TEST(Keyframes, SmoothMotionMeetsItsKeyframesWithoutAJerkAndRestsAtTheEnds)
{
  const Scene scene = sceneOf("smooth");
  const auto longitude = [&scene](double at) { return *sceneAt(scene, at).camera.longitude; };
  const double h = 1e-6;
  for (const auto& [at, value] :
    { std::pair(0.2, 10.0), std::pair(0.6, 50.0), std::pair(1.0, 60.0) })
  {
    EXPECT_NEAR(longitude(at), value, 1e-9);
  }
  EXPECT_NEAR((longitude(0.6 + h) - longitude(0.6)) / h, 50 / 0.8, 0.01);
  EXPECT_NEAR((longitude(0.6) - longitude(0.6 - h)) / h, 50 / 0.8, 0.01);
  EXPECT_NEAR((longitude(0.2 + h) - longitude(0.2)) / h, 0, 0.01);
  EXPECT_NEAR((longitude(1) - longitude(1 - h)) / h, 0, 0.01);
}

TEST(Keyframes, TheSunsDirectionKeepsUnitLength)
{
  const Triple sun = *sceneAt(sceneOf("linear"), 0.7).light.towardSun;
  EXPECT_NEAR(std::hypot(sun[0], sun[1], sun[2]), 1, 1e-12);
  EXPECT_GT(sun[0], 0.1);
  EXPECT_GT(sun[1], 0.1);
}
