// SPDX-License-Identifier: BSD-3-Clause
#include "ChoiceStudy.h"

#include "MethodChoice.h"
#include "MethodScenes.h"
#include "Quality.h"
#include "SceneParts.h"
#include "vtkCloudModelSelector.h"
#include "vtkNew.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <stdexcept>

namespace nephoscope
{
namespace charts
{
namespace
{
using program::MethodScene;
using program::SceneKind;

constexpr int Seed = 20001; ///< no calibration's
constexpr int Pixels = 300; ///< that are drawn exactly
constexpr double DearestSeconds = 1;

struct Family
{
  std::string name;
  std::string title;
  SceneKind kind;
};

const std::vector<Family>& families()
{
  static const std::vector<Family> all{
    { "clouds", "Light in height-field clouds, from below", SceneKind::CloudsFromBelow },
    { "clouds-above", "Light in height-field clouds, from above", SceneKind::CloudsFromAbove },
    { "haze", "Light in haze under clouds", SceneKind::HazeUnderClouds },
    { "clear-haze", "Light in haze without clouds", SceneKind::ClearHaze },
    { "cells", "Cells of a colour that varies", SceneKind::ColoredCells },
  };
  return all;
}

const Family& familyOf(const std::string& name)
{
  const auto found = std::find_if(families().begin(), families().end(),
    [&name](const Family& family) { return family.name == name; });
  if (found == families().end())
  {
    throw std::runtime_error("there is no family of methods '" + name + "'");
  }
  return *found;
}

/// The part's options in a scene.
std::vector<SceneOption> optionsOf(const MethodScene& scene)
{
  const vtkNew<vtkCloudModelSelector> selector;
  selector->SetCloudscape(scene.scape);
  for (ScenePart& part : selector->GetParts())
  {
    if (part.name == scene.part)
    {
      return std::move(part.options);
    }
  }
  return {};
}

class PictureJob : public performance::Job
{
public:
  PictureJob(MethodScene scene, const std::string& option)
    : Scene(std::move(scene))
  {
    for (const SceneOption& offered : optionsOf(this->Scene))
    {
      if (offered.name == option)
      {
        offered.apply();
      }
    }
  }

  void run() override
  {
    this->Scene.scape->Modified();
    this->Scene.scape->Update();
  }

  performance::Figures figures() override
  {
    const program::PictureErrors errors = program::errorsOf(this->Scene, Pixels);
    return { { "error", errors.error95 }, { "largestError", errors.largest } };
  }

private:
  MethodScene Scene;
};

performance::Method methodFor(SceneKind kind, const std::string& option)
{
  // "March, steps of 5 m" is March with a setting.
  const std::size_t comma = option.find(", ");
  performance::Method method;
  method.name = option.substr(0, comma);
  method.group = "choice";
  if (comma != std::string::npos)
  {
    method.settings[option.substr(comma + 2)] = "yes";
  }
  method.ours = true;
  method.prepare = [kind, option](const performance::Situation& s)
  { return std::make_unique<PictureJob>(program::methodScene(kind, Seed, s.pixels[0]), option); };
  return method;
}

/// The option that the selector takes for each tolerance.
std::vector<Choice> choicesIn(const MethodScene& scene)
{
  const vtkNew<vtkCloudModelSelector> selector;
  selector->SetCloudscape(scene.scape);
  program::useCalibration(selector);
  selector->SetSeconds(Endless);
  selector->Select();
  const double reachable = selector->GetPredictedError();
  selector->SetSeconds(0);
  std::vector<Choice> choices;
  for (const double tolerance : { 1e-1, 1e-2, 1e-3, 1e-4, 1e-5 })
  {
    choices.push_back({ tolerance, {}, reachable });
    if (tolerance >= reachable)
    {
      selector->SetTolerance(tolerance);
      selector->Select();
      choices.back().method = selector->GetTaken(scene.part);
    }
  }
  return choices;
}
}

const std::vector<std::string>& choiceFamilies()
{
  static const std::vector<std::string> names = []
  {
    std::vector<std::string> all;
    for (const Family& family : families())
    {
      all.push_back(family.name);
    }
    return all;
  }();
  return names;
}

std::string titleOfFamily(const std::string& family)
{
  return familyOf(family).title;
}

ChoiceStudy choiceStudy(const std::string& family, const performance::Situation& situation)
{
  const SceneKind kind = familyOf(family).kind;
  ChoiceStudy study;
  const auto ask = [&]
  {
    const MethodScene scene = program::methodScene(kind, Seed, situation.pixels[0]);
    std::vector<Choice> choices = choicesIn(scene);
    for (const SceneOption& option : optionsOf(scene))
    {
      const bool taken = std::any_of(choices.begin(), choices.end(),
        [&option](const Choice& choice) { return choice.method == option.name; });
      if (taken || (option.model != "nothing" && program::guessedSeconds(option) <= DearestSeconds))
      {
        study.methods.push_back(methodFor(kind, option.name));
      }
    }
    study.choices = std::move(choices);
  };
  // Methods run in forks of this process, which must have no threads then.
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1, "Sequential", false }, ask);
  return study;
}
}
}
