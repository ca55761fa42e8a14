// SPDX-License-Identifier: BSD-3-Clause
#include "SvgDrawing.h"

#include <algorithm>
#include <cstdio>

namespace nephoscope
{
namespace charts
{
namespace
{
std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

std::string attribute(const char* name, const std::string& value)
{
  return std::string(" ") + name + "=\"" + value + "\"";
}

const char* anchorName(Anchor anchor)
{
  return anchor == Anchor::Start ? "start" : anchor == Anchor::Middle ? "middle" : "end";
}

/// What is written after a "^" as a raised span.
std::string withExponents(const std::string& words, double size)
{
  std::string result;
  for (std::size_t at = 0; at < words.size();)
  {
    const std::size_t hat = words.find('^', at);
    result += escaped(words.substr(at, hat - at));
    if (hat == std::string::npos)
    {
      break;
    }
    const std::size_t end = std::min(words.find(' ', hat), words.size());
    const std::string rise = number(size * 0.38);
    result += "<tspan" + attribute("dy", "-" + rise) + attribute("font-size", number(size * 0.72)) +
      ">" + escaped(words.substr(hat + 1, end - hat - 1)) + "</tspan>";
    at = end;
    if (at < words.size())
    {
      result += "<tspan" + attribute("dy", rise) + "> </tspan>";
      ++at;
    }
  }
  return result;
}
}

std::string escaped(const std::string& words)
{
  std::string result;
  for (const char c : words)
  {
    switch (c)
    {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

SvgDrawing::SvgDrawing(double width, double height)
  : Width(width)
  , Height(height)
{
}

void SvgDrawing::line(
  double x0, double y0, double x1, double y1, const std::string& color, double width)
{
  this->polyline({ { x0, y0 }, { x1, y1 } }, color, width, "");
}

void SvgDrawing::polyline(const std::vector<std::pair<double, double>>& points,
  const std::string& color, double width, const std::string& dashes)
{
  std::string path;
  for (const auto& point : points)
  {
    path += (path.empty() ? "" : " ") + number(point.first) + "," + number(point.second);
  }
  this->Body += "<polyline" + attribute("points", path) + attribute("fill", "none") +
    attribute("stroke", color) + attribute("stroke-width", number(width)) +
    (dashes.empty() ? "" : attribute("stroke-dasharray", dashes)) + "/>\n";
}

void SvgDrawing::disc(double x, double y, double radius, const std::string& color, bool filled)
{
  this->Body += "<circle" + attribute("cx", number(x)) + attribute("cy", number(y)) +
    attribute("r", number(radius)) + attribute("fill", filled ? color : "#ffffff") +
    attribute("stroke", color) + attribute("stroke-width", "2") + "/>\n";
}

void SvgDrawing::text(double x, double y, const std::string& words, const TextStyle& style)
{
  const std::string place = number(x) + " " + number(y);
  this->Body += "<text" + attribute("x", number(x)) + attribute("y", number(y)) +
    attribute("font-size", number(style.size)) + attribute("fill", style.color) +
    attribute("text-anchor", anchorName(style.anchor)) +
    (style.bold ? attribute("font-weight", "bold") : "") +
    (style.upward ? attribute("transform", "rotate(-90 " + place + ")") : "") + ">" +
    withExponents(words, style.size) + "</text>\n";
}

std::string SvgDrawing::svg() const
{
  const std::string width = number(this->Width);
  const std::string height = number(this->Height);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg" +
    attribute("xmlns", "http://www.w3.org/2000/svg") + attribute("width", width) +
    attribute("height", height) + attribute("viewBox", "0 0 " + width + " " + height) +
    attribute("font-family", "DejaVu Sans, Verdana, sans-serif") + ">\n<rect" +
    attribute("width", width) + attribute("height", height) + attribute("fill", "#ffffff") +
    "/>\n" + this->Body + "</svg>\n";
}

double SvgDrawing::widthOf(const std::string& words, double size, bool bold)
{
  double em = 0;
  for (const char c : words)
  {
    const auto u = static_cast<unsigned char>(c);
    if ((u & 0xC0) == 0x80)
    {
      continue; // the rest of a character in UTF-8
    }
    const bool narrow = c == ' ' || c == '.' || c == ',' || c == 'i' || c == 'l' || c == 'j' ||
      c == '(' || c == ')' || c == 't' || c == 'f' || c == 'r' || c == ':';
    const bool wide = (c >= 'A' && c <= 'Z') || c == 'm' || c == 'w' || u >= 0x80;
    em += narrow ? 0.38 : wide ? 0.75 : 0.62;
  }
  return em * size * (bold ? 1.1 : 1);
}
}
}
