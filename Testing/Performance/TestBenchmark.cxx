// SPDX-License-Identifier: BSD-3-Clause
// The framework and what its groups promise, on small sizes; times are not asserted here.
#include "Benchmark.h"
#include "ShellCase.h"
#include "VolumeTruth.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <vector>

using namespace nephoscope::performance;

namespace
{
/// Takes memory, and fails or dies on request.
class Rehearsal : public Job
{
public:
  void run() override
  {
    if (++this->Runs == this->Failing)
    {
      throw std::runtime_error("failed in run " + std::to_string(this->Runs));
    }
    if (this->Runs == this->Dying)
    {
      std::abort();
    }
    std::vector<char> block(std::size_t(64) << 20, 1);
    this->Sum += block[block.size() / 2];
  }
  Figures figures() override { return { { "error", 0.25 }, { "runs", this->Runs } }; }
  int Runs = 0;
  int Failing = 0;
  int Dying = 0;
  int Sum = 0;
};

Method rehearsal(int failing = 0, int dying = 0)
{
  Method method;
  method.name = "Rehearsal";
  method.group = "rehearsal";
  method.settings = { { "speed", "slow" }, { "tempo", "3/4" } };
  method.prepare = [=](const Situation&)
  {
    auto job = std::make_unique<Rehearsal>();
    job->Failing = failing;
    job->Dying = dying;
    return job;
  };
  return method;
}

std::vector<Method> group(const std::string& name)
{
  std::vector<Method> found;
  for (const Method& method : methods())
  {
    if (method.group == name)
    {
      found.push_back(method);
    }
  }
  return found;
}

Situation smallSituation()
{
  Situation situation;
  situation.points = { 41, 24, 7 };
  situation.pixels = { 64, 48 };
  return situation;
}
}

TEST(Benchmark, CountsRunsMemoryAndFigures)
{
  const auto result = measure({ rehearsal() }, {}, { 4, 60 }, {});
  ASSERT_EQ(result.size(), 1U);
  const Measurement& m = result[0];
  EXPECT_EQ(m.leftOut, "");
  EXPECT_EQ(m.seconds.size(), 4U);
  EXPECT_EQ(m.figures.at("runs"), 5);
  EXPECT_EQ(m.figures.at("error"), 0.25);
  EXPECT_GT(m.median(), 0);
  EXPECT_GT(m.peakMemory - m.inputMemory, 60e6);
  EXPECT_LT(m.peakMemory - m.inputMemory, 80e6);
  EXPECT_EQ(m.method.label(), "Rehearsal (speed slow, tempo 3/4)");
}

TEST(Benchmark, StopsWhenTheSecondsAreUsed)
{
  const auto result = measure({ rehearsal() }, {}, { 1000, 0 }, {});
  EXPECT_EQ(result[0].seconds.size(), 0U);
  EXPECT_EQ(result[0].median(), result[0].firstSeconds);
}

TEST(Benchmark, AFailureOrADeathIsToldAndTheOthersGoOn)
{
  const auto result = measure({ rehearsal(2), rehearsal(0, 2), rehearsal() }, {}, { 2, 60 }, {});
  EXPECT_EQ(result[0].leftOut, "failed in run 2");
  EXPECT_EQ(result[1].leftOut, "its process ended before it answered");
  EXPECT_EQ(result[2].leftOut, "");
  EXPECT_EQ(result[2].seconds.size(), 2U);
}

TEST(Benchmark, MedianAndSpreadAreThoseOfTheRuns)
{
  Measurement m;
  m.seconds = { 5, 1, 4, 2, 3 };
  EXPECT_DOUBLE_EQ(m.median(), 3);
  EXPECT_DOUBLE_EQ(m.spread(), 1);
}

TEST(Benchmark, WhatIsTooMuchForAMethodIsLeftOut)
{
  Method method = rehearsal();
  method.mostCells = 10;
  const auto result = measure({ method }, smallSituation(), { 1, 1 }, {});
  EXPECT_NE(result[0].leftOut.find("minutes"), std::string::npos);
}

TEST(ShellCase, PlacesAndPositionsAreInverse)
{
  const Situation s = smallSituation();
  for (int n = 1; n < 200; ++n)
  {
    const shell::Place p = shell::placeOnGrid(s, n * 0.2, (n * 7 % 23) + 0.5, (n * 5 % 13) * 0.45);
    const shell::Place back = shell::place(shell::position(p));
    EXPECT_NEAR(back.longitude, p.longitude, 1e-12);
    EXPECT_NEAR(back.latitude, p.latitude, 1e-12);
    EXPECT_NEAR(back.eta, p.eta, 1e-10);
  }
}

TEST(ContourMethods, TheSameTetrahedraGiveTheSameSurface)
{
  // Merged or not, with normals or not, and by our lattice without tetrahedra: one surface.
  std::vector<Method> onTetrahedra;
  for (const Method& method : group("contour"))
  {
    if (method.settings.count("grid") == 0)
    {
      onTetrahedra.push_back(method);
    }
  }
  ASSERT_GE(onTetrahedra.size(), 3U);
  Situation
    situation; // so many triangles that what a float coordinate rounds off averages to less than 1e-9
  situation.points = { 320, 160, 10 };
  const auto result = measure(onTetrahedra, situation, { 0, 60 }, {});
  const Figures& first = result[0].figures;
  EXPECT_GT(first.at("triangles"), 1000);
  for (const Measurement& m : result)
  {
    ASSERT_EQ(m.leftOut, "") << m.method.label();
    EXPECT_EQ(m.figures.at("triangles"), first.at("triangles")) << m.method.label();
    // Merging, vtkContour3DLinearGrid keeps where it cut an edge as a float.
    const bool rounded = !m.method.ours && m.method.settings.at("points") == "merged";
    EXPECT_NEAR(m.figures.at("area") / first.at("area"), 1, rounded ? 1e-8 : 1e-9)
      << m.method.label();
  }
}

TEST(ContourMethods, ErrorsFallWithTheSpacing)
{
  // Linear interpolation is of second order: four times less for half the spacing once the shortest wave, 7 points long here,
  // is resolved, and at least twice on the way there.
  Situation coarse;
  coarse.points = { 240, 120, 6 };
  Situation fine;
  fine.points = { 480, 240, 11 };
  std::vector<Method> all; // one of each class: its other settings draw the same surface
  for (const Method& method : group("contour"))
  {
    if (all.empty() || all.back().name != method.name)
    {
      all.push_back(method);
    }
  }
  const auto rough = measure(all, coarse, { 0, 60 }, {});
  const auto smooth = measure(all, fine, { 0, 60 }, {});
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const double ratio = rough[i].figures.at("error") / smooth[i].figures.at("error");
    EXPECT_GT(ratio, 2) << all[i].label();
    EXPECT_LT(ratio, 5) << all[i].label();
  }
}

namespace
{
/// Checks the volume methods of a group; returns those without a window by their setting "order".
std::map<std::string, Figures> drawnInGroup(const std::string& name)
{
  Situation situation = smallSituation();
  situation.pixels = { 160, 120 };
  std::map<std::string, Figures> drawn;
  for (const Measurement& m : measure(group(name), situation, { 1, 60 }, {}))
  {
    if (m.method.window && !haveDisplay())
    {
      EXPECT_NE(m.leftOut.find("xvfb-run"), std::string::npos) << m.method.label();
      continue;
    }
    EXPECT_EQ(m.leftOut, "") << m.method.label();
    if (!m.leftOut.empty())
    {
      continue;
    }
    EXPECT_GT(m.figures.at("pixelsCompared"), 1000);
    // A window has 8 bits, whose root mean square is 1.1e-3; peers, on an image, have another sampling.
    EXPECT_LT(m.figures.at("error"), m.method.ours && m.method.window ? 2e-3 : 0.25)
      << m.method.label();
    EXPECT_NEAR(m.figures.at("shown"), 1, 0.3) << m.method.label();
    if (!m.method.window)
    {
      drawn[m.method.settings.at("order")] = m.figures;
    }
    std::printf("%-70s first %.3f s, then %.3f s, error %.2g, largest %.2g\n",
      m.method.label().c_str(), m.firstSeconds, m.median(), m.figures.at("error"),
      m.figures.at("largestError"));
  }
  return drawn;
}
}

TEST(VolumeMethods, EachDrawsTheShellOrSaysWhyNot)
{
  const auto drawn = drawnInGroup("volume");
  EXPECT_EQ(drawn.size(), 2U);
  for (const auto& method : drawn)
  {
    EXPECT_LT(method.second.at("largestError"), 1e-5) << method.first;
  }
}

TEST(VolumeMethods, TheOrdersOfCellsAreAsExactAsTheyCanBe)
{
  auto drawn = drawnInGroup("order");
  ASSERT_EQ(drawn.size(), 3U);
  EXPECT_LT(drawn["per pixel"].at("largestError"), 1e-5);
  EXPECT_EQ(drawn["visibility"].at("cycles"), 0);
  EXPECT_LT(drawn["visibility"].at("largestError"), 1e-5);
  EXPECT_GT(drawn["centroid"].at("error"), 100 * drawn["visibility"].at("error"));
}

TEST(VolumeMethods, APictureOfNothingIsToldNotCharted)
{
  Situation situation = smallSituation();
  try
  {
    volumeFigures(situation, &TruePixel::transmittance, [](int, int) { return 1.0; });
    FAIL() << "an empty picture was compared";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_STREQ(error.what(), "its picture shows 0 times the cloud that there is");
  }
}

TEST(AdvectionMethods, ErrorsFallWithTheSchemeAndNoPointIsLost)
{
  Situation situation;
  situation.points = { 81, 40, 5 };
  std::map<std::string, Figures> ours;
  for (const Measurement& m : measure(group("advection"), situation, { 1, 60 }, {}))
  {
    ASSERT_EQ(m.leftOut, "") << m.method.label();
    EXPECT_GT(m.figures.at("error"), 0) << m.method.label();
    if (m.method.ours)
    {
      EXPECT_EQ(m.figures.at("lost"), 0) << m.method.label();
      ours[m.method.settings.at("integrator") + " " + m.method.settings.at("interpolation") + " " +
        m.method.settings.at("tolerance")] = m.figures;
    }
    else
    {
      EXPECT_LT(m.figures.at("lost"), 0.6)
        << m.method.label(); // the top and the bottom of five levels
    }
  }
  // Errors are below the tolerance, but for what linear interpolation between columns 500 km apart adds.
  EXPECT_LT(ours.at("RK2 linear 5000 m").at("largestError"), 5500);
  EXPECT_LT(ours.at("RK2 linear 500 m").at("largestError"), 1000);
  EXPECT_LT(ours.at("RK2 cubic 500 m").at("largestError"), 500);
  EXPECT_LT(ours.at("RK2 cubic 5 m").at("error"), ours.at("RK2 cubic 500 m").at("error") / 10);
  EXPECT_GT(ours.at("RK2 cubic 5 m").at("substeps"), ours.at("RK2 cubic 500 m").at("substeps"));
}

TEST(VoxelMethods, EachDrawsTheCloudOrSaysWhyNot)
{
  Situation situation;
  situation.points = { 64, 64, 64 };
  situation.pixels = { 256, 192 };
  for (const Measurement& m : measure(group("voxels"), situation, { 1, 60 }, {}))
  {
    if (!m.method.ours && m.leftOut.find("libopenvdb-tools") != std::string::npos)
    {
      std::printf("%s: %s\n", m.method.label().c_str(), m.leftOut.c_str());
      continue;
    }
    ASSERT_EQ(m.leftOut, "") << m.method.label();
    EXPECT_GT(m.figures.at("pixelsCompared"), 40);
    EXPECT_LT(m.figures.at("error"), m.method.ours ? 0.01 : 0.2) << m.method.label();
    std::printf("%-40s first %.3f s, then %.3f s, error %.2g\n", m.method.label().c_str(),
      m.firstSeconds, m.median(), m.figures.at("error"));
  }
}

TEST(ConversionMethods, MeansKeepTheMassAndAreCloserThanCentres)
{
  Situation situation;
  situation.points = { 160, 90, 13 };
  std::vector<Method> coarse; // the finest take long with sanitizers
  for (const Method& method : group("conversion"))
  {
    if (method.settings.at("voxels a cell") != "4")
    {
      coarse.push_back(method);
    }
  }
  ASSERT_EQ(coarse.size(), 4U);
  const auto measured = measure(coarse, situation, { 1, 60 }, {});
  for (const Measurement& m : measured)
  {
    ASSERT_EQ(m.leftOut, "") << m.method.label();
    std::printf("%-40s first %.3f s, then %.3f s, error %.3g, of mass %.2g\n",
      m.method.label().c_str(), m.firstSeconds, m.median(), m.figures.at("error"),
      m.figures.at("massError"));
    EXPECT_LT(m.figures.at("error"), 0.3) << m.method.label();
    EXPECT_LT(m.figures.at("massError"), m.method.ours ? 1e-5 : 0.05) << m.method.label();
    for (const Measurement& other : measured)
    {
      if (m.method.ours && !other.method.ours && m.method.settings == other.method.settings)
      {
        EXPECT_LT(m.figures.at("error"), other.figures.at("error")) << m.method.label();
      }
    }
  }
}
