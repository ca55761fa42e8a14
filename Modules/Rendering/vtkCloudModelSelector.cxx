// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudModelSelector.h"

#include "Calibration.h"
#include "MethodChoice.h"
#include "SceneParts.h"
#include "vtkCloudscape.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

vtkStandardNewMacro(vtkCloudModelSelector);

namespace
{
using nephoscope::MethodOption;
using nephoscope::ScenePart;

struct Models
{
  nephoscope::CostModel Cost;
  nephoscope::ErrorModel Error;
};

std::string shortly(double value)
{
  std::ostringstream text;
  text.precision(2);
  text << value;
  return text.str();
}

std::string figuresOf(const MethodOption& option)
{
  return "error " + shortly(option.error) + ", " + shortly(option.seconds) + " s";
}

const nephoscope::Fit* find(const nephoscope::Calibration& calibration, const std::string& name)
{
  const auto found = std::find_if(calibration.fits.begin(), calibration.fits.end(),
    [&name](const nephoscope::Fit& fit) { return fit.name == name; });
  return found == calibration.fits.end() ? nullptr : &*found;
}
}

struct vtkCloudModelSelector::Internals
{
  vtkSmartPointer<vtkCloudscape> Scape;
  std::map<std::string, Models> Of;
  std::set<std::string> Calibrated; ///< the models with constants of a calibration
  std::vector<nephoscope::ChoicePart> Offered;
  std::vector<ScenePart> Parts;
  nephoscope::MethodChoice Choice;

  Internals()
  {
    for (const nephoscope::MethodModel& model : nephoscope::methodModels())
    {
      this->Of[model.name] = { { model.seconds }, { model.scale, model.power } };
    }
  }

  void Offer()
  {
    this->Offered.clear();
    for (const ScenePart& part : this->Parts)
    {
      nephoscope::ChoicePart offered{ part.name, {} };
      for (const nephoscope::SceneOption& option : part.options)
      {
        const Models& models = this->Of.at(option.model);
        offered.options.push_back({ option.name, models.Cost.seconds(option.work),
          option.bound + models.Error.error(option.coarseness) });
      }
      this->Offered.push_back(std::move(offered));
    }
  }

  /// Why an option was not taken.
  std::string Against(const MethodOption& option, const MethodOption& taken) const
  {
    if (option.error >= taken.error && option.seconds >= taken.seconds)
    {
      return "no better in either";
    }
    return option.error > taken.error ? "not exact enough" : "slower than needed";
  }

  void ExplainPart(std::size_t p, std::ostream& out) const
  {
    const std::vector<MethodOption>& options = this->Offered[p].options;
    const std::size_t taken = this->Choice.options[p];
    out << this->Offered[p].name << ": " << options[taken].name << " (" << figuresOf(options[taken])
        << ')';
    if (this->Parts[p].options[taken].model == "nothing" &&
      !this->Parts[p].options[taken].leavesOut)
    {
      out << ", of which nothing is known";
    }
    out << '\n';
    for (std::size_t o = 0; o < options.size(); ++o)
    {
      if (o != taken)
      {
        out << "  not " << options[o].name << " (" << figuresOf(options[o])
            << "): " << this->Against(options[o], options[taken]) << '\n';
      }
    }
  }
};

vtkCloudModelSelector::vtkCloudModelSelector()
  : Data(std::make_unique<Internals>())
{
}

vtkCloudModelSelector::~vtkCloudModelSelector() = default;

void vtkCloudModelSelector::SetCloudscape(vtkCloudscape* scape)
{
  if (this->Data->Scape != scape)
  {
    this->Data->Scape = scape;
    this->Modified();
  }
}

vtkCloudscape* vtkCloudModelSelector::GetCloudscape() const
{
  return this->Data->Scape;
}

void vtkCloudModelSelector::SetCalibration(const nephoscope::Calibration& calibration)
{
  for (const nephoscope::MethodModel& model : nephoscope::methodModels())
  {
    Models& models = this->Data->Of[model.name];
    if (const nephoscope::Fit* const fit = find(calibration, model.name + " seconds"))
    {
      models.Cost.coefficients.clear();
      for (const std::string& work : model.work)
      {
        models.Cost.coefficients.push_back(1e-6 * fit->value(work)); // of microseconds
      }
      this->Data->Calibrated.insert(model.name);
    }
    const nephoscope::Fit* const fit = find(calibration, model.name + " error");
    if (fit && model.isBounded)
    {
      models.Error = { fit->value("scale"), fit->value("power") };
    }
  }
  this->Modified();
}

bool vtkCloudModelSelector::IsReady()
{
  if (!this->Data->Scape || !this->Data->Scape->GetCamera())
  {
    vtkErrorMacro("There is no cloudscape with a camera: call SetCloudscape first.");
    return false;
  }
  if ((this->Tolerance != 0) == (this->Seconds != 0))
  {
    vtkErrorMacro("Set either Tolerance or Seconds: they are " << this->Tolerance << " and "
                                                               << this->Seconds << '.');
    return false;
  }
  return true;
}

bool vtkCloudModelSelector::Select()
{
  if (!this->IsReady())
  {
    return false;
  }
  Internals& data = *this->Data;
  data.Parts = nephoscope::partsOf(data.Scape);
  data.Offer();
  try
  {
    data.Choice = this->Tolerance != 0 ? nephoscope::cheapestChoice(data.Offered, this->Tolerance)
                                       : nephoscope::mostExactChoice(data.Offered, this->Seconds);
  }
  catch (const nephoscope::ChoiceError& error)
  {
    data.Choice = {};
    vtkErrorMacro(<< error.what());
    return false;
  }
  for (std::size_t p = 0; p < data.Parts.size(); ++p)
  {
    data.Parts[p].options[data.Choice.options[p]].apply();
  }
  this->PredictedError = data.Choice.error;
  this->PredictedSeconds = data.Choice.seconds;
  return true;
}

void vtkCloudModelSelector::SelectExact()
{
  for (const ScenePart& part : this->GetParts())
  {
    for (const nephoscope::SceneOption& option : part.options)
    {
      if (option.exact)
      {
        option.apply();
      }
    }
  }
}

std::string vtkCloudModelSelector::Explain() const
{
  const Internals& data = *this->Data;
  if (data.Choice.options.empty())
  {
    return "nothing was chosen\n";
  }
  std::ostringstream out;
  out << (this->Tolerance != 0
             ? "the cheapest methods with an error of at most " + shortly(this->Tolerance)
             : "the most exact methods in at most " + shortly(this->Seconds) + " s")
      << ": predicted error " << shortly(this->PredictedError) << ", "
      << shortly(this->PredictedSeconds) << " s\n";
  std::string left;
  std::set<std::string> guessed;
  for (std::size_t p = 0; p < data.Parts.size(); ++p)
  {
    data.ExplainPart(p, out);
    const nephoscope::SceneOption& taken = data.Parts[p].options[data.Choice.options[p]];
    left += taken.leavesOut ? "  " + data.Parts[p].name + ": " + taken.name +
        ", changes no pixel by more than " + shortly(taken.bound) + '\n'
                            : "";
    if (taken.model != "nothing" && data.Calibrated.count(taken.model) == 0)
    {
      guessed.insert(taken.model);
    }
  }
  out << "left out:" << (left.empty() ? " nothing\n" : "\n" + left);
  for (const std::string& model : guessed)
  {
    out << "not calibrated, by built-in constants: " << model << '\n';
  }
  return out.str();
}

std::string vtkCloudModelSelector::GetTaken(const std::string& part) const
{
  const Internals& data = *this->Data;
  for (std::size_t p = 0; p < data.Choice.options.size(); ++p)
  {
    if (data.Offered[p].name == part)
    {
      return data.Offered[p].options[data.Choice.options[p]].name;
    }
  }
  return {};
}

std::vector<ScenePart> vtkCloudModelSelector::GetParts() const
{
  return this->Data->Scape && this->Data->Scape->GetCamera()
    ? nephoscope::partsOf(this->Data->Scape)
    : std::vector<ScenePart>();
}

const std::vector<nephoscope::MethodModel>& vtkCloudModelSelector::GetModels()
{
  return nephoscope::methodModels();
}

void vtkCloudModelSelector::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Cloudscape: " << this->Data->Scape.Get() << '\n';
  os << indent << "Tolerance: " << this->Tolerance << '\n';
  os << indent << "Seconds: " << this->Seconds << '\n';
  os << indent << "PredictedError: " << this->PredictedError << '\n';
  os << indent << "PredictedSeconds: " << this->PredictedSeconds << '\n';
}
