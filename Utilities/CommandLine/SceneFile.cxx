// SPDX-License-Identifier: BSD-3-Clause
#include "SceneFile.h"

#include "Failure.h"
#include "Nearest.h"
#include "SceneKeys.h"

#include <NumberText.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace nephoscope::program
{
namespace
{
/// A node with the file's name, so that a message can say where it stands.
struct Place
{
  const std::string& File;
  YAML::Node Node;

  [[noreturn]] void fail(const std::string& message) const
  {
    const YAML::Mark mark = this->Node.Mark();
    const std::string line = mark.is_null() ? "" : std::to_string(mark.line + 1) + ":";
    throw UsageFailure(this->File + ":" + line + " " + message);
  }
  Place at(const YAML::Node& node) const { return { this->File, node }; }
};

std::string inQuotes(const std::string& word)
{
  return "'" + word + "'";
}

/// ", in km" for a key that has a unit.
std::string inUnit(const Key& key)
{
  const std::string unit = key.unit;
  return unit.empty() || unit == "1" ? std::string() : ", in " + unit;
}

void assign(const Place& place, const Key& key, double& value)
{
  if (!place.Node.IsScalar() || !YAML::convert<double>::decode(place.Node, value) ||
    !std::isfinite(value))
  {
    place.fail(inQuotes(key.name) + " must be a number" + inUnit(key));
  }
  if (value < key.least || value > key.most)
  {
    place.fail(inQuotes(key.name) + " is " + numberText(value) + "; it must be from " +
      numberText(key.least) + " to " + numberText(key.most));
  }
}

void assign(const Place& place, const Key& key, int& value)
{
  double number = 0;
  assign(place, key, number);
  if (number != std::floor(number))
  {
    place.fail(inQuotes(key.name) + " must be a whole number");
  }
  value = static_cast<int>(number);
}

void assign(const Place& place, const Key& key, bool& value)
{
  if (!place.Node.IsScalar() || !YAML::convert<bool>::decode(place.Node, value))
  {
    place.fail(inQuotes(key.name) + " must be true or false");
  }
}

void assign(const Place& place, const Key& key, std::string& value)
{
  if (!place.Node.IsScalar() || place.Node.Scalar().empty())
  {
    place.fail(inQuotes(key.name) + " must be a text");
  }
  value = place.Node.Scalar();
  if (!key.choices.empty() &&
    std::find(key.choices.begin(), key.choices.end(), value) == key.choices.end())
  {
    place.fail(
      inQuotes(key.name) + " cannot be " + inQuotes(value) + "; " + suggestion(value, key.choices));
  }
}

template <class Number, std::size_t N>
void assign(const Place& place, const Key& key, std::array<Number, N>& values)
{
  if (!place.Node.IsSequence() || place.Node.size() != N)
  {
    place.fail(
      inQuotes(key.name) + " must be a list of " + std::to_string(N) + " numbers" + inUnit(key));
  }
  for (std::size_t i = 0; i < N; ++i)
  {
    assign(place.at(place.Node[i]), key, values[i]);
  }
}

void assign(const Place& place, const Key& key, std::map<std::string, std::string>& words)
{
  if (!place.Node.IsMap())
  {
    place.fail(inQuotes(key.name) + " must be a mapping, ROLE: NAME");
  }
  for (const auto& entry : place.Node)
  {
    Key role = key;
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : std::string();
    role.name = name.c_str();
    assign(place.at(entry.second), role, words[name]);
  }
}

template <class Value>
void assign(const Place& place, const Key& key, std::optional<Value>& value)
{
  assign(place, key, value.emplace());
}

/// The keys of a mapping node, each once. @throw UsageFailure if it is something else
std::map<std::string, YAML::Node> keysOf(const Place& place, const std::string& what)
{
  if (!place.Node.IsMap())
  {
    place.fail(inQuotes(what) + " must be a mapping, key: value");
  }
  std::map<std::string, YAML::Node> found;
  for (const auto& entry : place.Node)
  {
    if (!entry.first.IsScalar())
    {
      place.at(entry.first).fail("a key of " + inQuotes(what) + " must be a word");
    }
    if (!found.emplace(entry.first.Scalar(), entry.second).second)
    {
      place.at(entry.first)
        .fail("the key " + inQuotes(entry.first.Scalar()) + " stands twice in " + inQuotes(what));
    }
  }
  return found;
}

void refuseUnknown(
  const Place& place, const std::string& what, const std::vector<std::string>& known)
{
  for (const auto& entry : place.Node)
  {
    const std::string& key = entry.first.Scalar();
    if (std::find(known.begin(), known.end(), key) == known.end())
    {
      place.at(entry.first)
        .fail(
          "unknown key " + inQuotes(key) + " in " + inQuotes(what) + "; " + suggestion(key, known));
    }
  }
}

template <class Part>
void readMapping(
  const Place& place, const std::string& what, Part& part, std::vector<std::string> known = {})
{
  const auto given = keysOf(place, what);
  visitKeys(part, [&known](const Key& key, auto&) { known.emplace_back(key.name); });
  refuseUnknown(place, what, known);
  visitKeys(part,
    [&given, &place](const Key& key, auto& value)
    {
      const auto found = given.find(key.name);
      if (found != given.end())
      {
        assign(place.at(found->second), key, value);
      }
    });
}

/// What single keys allow but not together.
template <class Part>
void refuseTogether(const Place&, const Part&)
{
}

void refuseTogether(const Place& place, const TerrainBody& body)
{
  constexpr double Most = 16384; // vtkCloudTerrainSource's 2^28 points
  const double across = 1 + std::ceil(1000 * body.extent / body.spacing);
  if (across > Most)
  {
    place.fail("terrain of 'extent' " + numberText(body.extent) + " km at 'spacing' " +
      numberText(body.spacing) + " m is " + numberText(across) + " points wide; at most " +
      numberText(Most) + ": give a smaller extent or a larger spacing");
  }
}

template <class Part>
Part readTyped(const Place& place, const std::string& what)
{
  std::vector<std::string> types;
  visitTypes(static_cast<Part*>(nullptr),
    [&types](const char* name, const char*, auto) { types.emplace_back(name); });
  if (!place.Node.IsMap())
  {
    place.fail(
      "a part of " + inQuotes(what) + " must be a mapping, such as { type: " + types[0] + " }");
  }
  const auto given = keysOf(place, what);
  const auto found = given.find("type");
  if (found == given.end())
  {
    place.fail(
      "a part of " + inQuotes(what) + " has no 'type'; give one, such as type: " + types[0]);
  }
  Key key{ "type", "", "", "" };
  key.choices = types;
  std::string type;
  assign(place.at(found->second), key, type);
  Part read;
  visitTypes(static_cast<Part*>(nullptr),
    [&](const char* name, const char*, auto part)
    {
      if (type == name)
      {
        readMapping(place, type, part, { "type" });
        refuseTogether(place, part);
        read = part;
      }
    });
  return read;
}

template <>
Keyframe readTyped(const Place& place, const std::string& what)
{
  Keyframe frame;
  readMapping(place, what, frame);
  return frame;
}

template <class Part>
void readList(const Place& place, const std::string& what, std::vector<Part>& parts)
{
  if (!place.Node.IsSequence())
  {
    place.fail(inQuotes(what) + " must be a list, each part beginning with '- " +
      (std::is_same_v<Part, Keyframe> ? "at: '" : "type: '"));
  }
  for (const auto& node : place.Node)
  {
    parts.push_back(readTyped<Part>(place.at(node), what));
  }
}

Scene readSections(const Place& place)
{
  const auto given = keysOf(place, "scene");
  std::vector<std::string> known;
  const auto name = [&known](const char* section, auto&) { known.emplace_back(section); };
  Scene scene;
  visitSections(scene, name, name);
  refuseUnknown(place, "scene", known);
  visitSections(
    scene,
    [&](const char* section, auto& part)
    {
      if (given.count(section))
      {
        readMapping(place.at(given.at(section)), section, part);
      }
    },
    [&](const char* section, auto& parts)
    {
      if (given.count(section))
      {
        readList(place.at(given.at(section)), section, parts);
      }
    });
  return scene;
}

const char* typeName(const std::string&)
{
  return "text";
}
const char* typeName(bool)
{
  return "true or false";
}
const char* typeName(int)
{
  return "number";
}
const char* typeName(double)
{
  return "number";
}
template <class Number, std::size_t N>
const char* typeName(const std::array<Number, N>&)
{
  return N == 2 ? "2 numbers" : "3 numbers";
}
const char* typeName(const std::map<std::string, std::string>&)
{
  return "mapping";
}
template <class Value>
const char* typeName(const std::optional<Value>&)
{
  return typeName(Value());
}

template <class Part>
void describe(std::ostream& out, Part part)
{
  out << "\n| key | type | unit | default | meaning |\n| --- | --- | --- | --- | --- |\n";
  visitKeys(part,
    [&out](const Key& key, const auto& value)
    {
      std::string meaning = key.meaning;
      for (std::size_t i = 0; i < key.choices.size(); ++i)
      {
        meaning += (i ? ", " : ": ") + key.choices[i];
      }
      out << "| `" << key.name << "` | " << typeName(value) << " | " << key.unit << " | "
          << key.initial << " | " << meaning << " |\n";
    });
}
}

Scene parseScene(const std::string& text, const std::string& name)
{
  YAML::Node root;
  try
  {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1)
    {
      throw UsageFailure(name + ": holds " + std::to_string(documents.size()) +
        " YAML documents, divided by '---'; a scene is one");
    }
    root = documents.empty() ? YAML::Node() : documents.front();
  }
  catch (const YAML::Exception& error)
  {
    throw UsageFailure(
      name + ":" + std::to_string(error.mark.line + 1) + ": is not YAML: " + error.msg);
  }
  Scene scene = readSections({ name, root });
  scene.file = name;
  const auto fromScene = [&name](const std::string& file)
  { return (std::filesystem::path(name).parent_path() / file).lexically_normal().string(); };
  if (!scene.data.file.empty())
  {
    scene.data.file = fromScene(scene.data.file);
  }
  for (Body& body : scene.bodies)
  {
    auto* const clouds = std::get_if<HeightFieldBody>(&body);
    if (clouds && clouds->calibration != "none" && clouds->calibration != "shipped")
    {
      clouds->calibration = fromScene(clouds->calibration);
    }
    auto* const voxels = std::get_if<VoxelBody>(&body);
    if (voxels && !voxels->file.empty())
    {
      voxels->file = fromScene(voxels->file);
    }
  }
  validate(scene, name);
  return scene;
}

Scene readScene(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
  {
    throw Failure(path +
      (std::filesystem::exists(path, error) ? ": is not a file; name a scene file"
                                            : ": there is no such scene file"));
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream)
  {
    throw Failure(path + ": cannot be read, or is empty");
  }
  return parseScene(text.str(), path);
}

std::string sceneReference()
{
  std::ostringstream out;
  Scene scene;
  visitSections(
    scene,
    [&out](const char* section, auto& part)
    {
      out << "\n## " << section << "\n";
      describe(out, part);
    },
    [&out](const char* section, auto& parts)
    {
      out << "\n## " << section << "\n";
      if constexpr (std::is_same_v<decltype(parts), std::vector<Keyframe>&>)
      {
        out << "\nA list in rising order of `at`.\n";
        describe(out, Keyframe());
        return;
      }
      else
      {
        out << "\nA list; each part begins with its `type`.\n";
        visitTypes(parts.data(),
          [&out](const char* type, const char* meaning, auto part)
          {
            out << "\n### " << type << "\n\n" << meaning << "\n";
            describe(out, part);
          });
      }
    });
  return out.str();
}
}
