// SPDX-License-Identifier: BSD-3-Clause
#include "CalibrationFile.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace nephoscope
{
namespace
{
using Json = nlohmann::ordered_json;

constexpr const char* Format = "nephoscope calibration";
constexpr int Version = 1;

/// FNV-1a, 64 bits: Fowler, Noll and Vo, draft-eastlake-fnv.
std::string checksum(const std::string& text)
{
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text)
  {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

Json jsonOf(const RemainingError& error)
{
  return { { "cases", error.cases }, { "bias", error.bias }, { "rms", error.rms },
    { "median", error.median }, { "p95", error.p95 }, { "max", error.max } };
}

Json jsonOf(const FittedParameter& p)
{
  return { { "name", p.name }, { "value", p.value }, { "standard_error", p.standardError },
    { "lower", p.lower }, { "upper", p.upper }, { "at_bound", p.atBound },
    { "determined", p.determined } };
}

Json jsonOf(const Fit& fit)
{
  Json parameters = Json::array();
  for (const FittedParameter& parameter : fit.parameters)
  {
    parameters.push_back(jsonOf(parameter));
  }
  return { { "name", fit.name }, { "residual", fit.residual }, { "parameters", parameters },
    { "covariance", fit.covariance }, { "training", jsonOf(fit.training) },
    { "held_out", jsonOf(fit.heldOut) }, { "iterations", fit.iterations },
    { "warnings", fit.warnings } };
}

RemainingError errorOf(const Json& json)
{
  return { json.at("cases"), json.at("bias"), json.at("rms"), json.at("median"), json.at("p95"),
    json.at("max") };
}

Fit fitOf(const Json& json)
{
  Fit fit;
  fit.name = json.at("name");
  fit.residual = json.at("residual");
  for (const Json& p : json.at("parameters"))
  {
    fit.parameters.push_back({ p.at("name"), p.at("value"), p.at("standard_error"), p.at("lower"),
      p.at("upper"), p.at("at_bound"), p.at("determined") });
  }
  fit.covariance = json.at("covariance").get<std::vector<double>>();
  fit.training = errorOf(json.at("training"));
  fit.heldOut = errorOf(json.at("held_out"));
  fit.iterations = json.at("iterations");
  fit.warnings = json.at("warnings").get<std::vector<std::string>>();
  return fit;
}

std::string contentOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  file.peek(); // a folder can be opened, but not read
  if (!file.is_open() || file.bad())
  {
    throw ReadError(
      path + ": there is no calibration to read; make one with nephoscope fit WHAT -o " + path);
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Json parsed(const std::string& path)
{
  try
  {
    return Json::parse(contentOf(path));
  }
  catch (const Json::parse_error& error)
  {
    throw ReadError(path + ": is cut short or no JSON, at byte " + std::to_string(error.byte) +
      "; make it again with nephoscope fit or calibrate");
  }
}

/// That it is a calibration of a version that is known, whole and as it was written.
void checkHead(const std::string& path, Json& json)
{
  if (!json.is_object() || json.value("format", Json()) != Format)
  {
    throw ReadError(path + ": is no nephoscope calibration: its format is not '" + Format + "'");
  }
  const Json version = json.value("version", Json());
  if (!version.is_number_integer() || version < 1)
  {
    throw ReadError(path + ": has no version; make it again with nephoscope fit or calibrate");
  }
  if (version > Version)
  {
    throw ReadError(path + ": is of version " + version.dump() + ", newer than " +
      std::to_string(Version) + ", the latest that is known here; update nephoscope");
  }
  const Json stored = json.value("checksum", Json());
  json.erase("checksum");
  if (stored != checksum(json.dump()))
  {
    const Json command = json.value("command", Json());
    throw ReadError(path + ": was edited by hand, so its errors are not those of its constants; " +
      "make it again with " +
      (command.is_string() ? command.get<std::string>() : "nephoscope fit or calibrate") + " -o " +
      path);
  }
}
}

namespace
{
/// A line for each member, and for each fit.
std::string lines(const Json& json)
{
  std::string text;
  for (const auto& [key, value] : json.items())
  {
    text += (text.empty() ? "{" : ",\n ") + Json(key).dump() + ": ";
    if (key != "fits")
    {
      text += value.dump();
      continue;
    }
    const char* before = "[\n  ";
    for (const Json& fit : value)
    {
      text += before + fit.dump();
      before = ",\n  ";
    }
    text += value.empty() ? "[]" : "]";
  }
  return text + "}\n";
}
}

std::string calibrationText(const Calibration& calibration)
{
  Json fits = Json::array();
  for (const Fit& fit : calibration.fits)
  {
    fits.push_back(jsonOf(fit));
  }
  Json json{ { "format", Format }, { "version", Version }, { "what", calibration.what },
    { "command", calibration.command }, { "fits", fits } };
  json["checksum"] = checksum(json.dump());
  return lines(json);
}

Calibration readCalibration(const std::string& path, const std::string& what)
{
  Json json = parsed(path);
  checkHead(path, json);
  Calibration calibration;
  try
  {
    calibration.what = json.at("what");
    calibration.command = json.at("command");
    for (const Json& fit : json.at("fits"))
    {
      calibration.fits.push_back(fitOf(fit));
    }
  }
  catch (const Json::exception&)
  {
    throw ReadError(
      path + ": lacks a part of a calibration; make it again with nephoscope fit or calibrate");
  }
  const std::string wrong = whatIsWrong(calibration);
  if (!wrong.empty())
  {
    throw ReadError(path + ": " + wrong);
  }
  if (!what.empty() && calibration.what != what)
  {
    throw ReadError(
      path + ": has constants of '" + calibration.what + "', not of '" + what + "'; give another");
  }
  return calibration;
}
}
