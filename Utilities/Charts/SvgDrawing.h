// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SvgDrawing.h
 * @brief Lines, discs and words of a chart as SVG, and the same as PNG.
 *
 * Coordinates are pixels from the upper left corner, y downward.
 */
#ifndef SvgDrawing_h
#define SvgDrawing_h

#include <string>
#include <utility>
#include <vector>

namespace nephoscope
{
namespace charts
{
/// A rectangle, for finding out what overlaps.
struct Box
{
  double left, top, right, bottom;

  bool overlaps(const Box& other) const
  {
    return this->left < other.right && other.left < this->right && this->top < other.bottom &&
      other.top < this->bottom;
  }
  bool holds(const Box& other) const
  {
    return this->left <= other.left && other.right <= this->right && this->top <= other.top &&
      other.bottom <= this->bottom;
  }
};

enum class Anchor
{
  Start,
  Middle,
  End
};

struct TextStyle
{
  double size = 14; ///< pixels
  std::string color = "#222222";
  Anchor anchor = Anchor::Start;
  bool bold = false;
  bool upward = false; ///< turned by a right angle, reading upward
};

class SvgDrawing
{
public:
  SvgDrawing(double width, double height);

  void line(double x0, double y0, double x1, double y1, const std::string& color, double width);
  /// @param dashes as SVG's stroke-dasharray, empty for none
  void polyline(const std::vector<std::pair<double, double>>& points, const std::string& color,
    double width, const std::string& dashes);
  void disc(double x, double y, double radius, const std::string& color, bool filled);
  /// Text is escaped; "^" and what follows it up to a blank stands higher: "10^-3".
  void text(double x, double y, const std::string& words, const TextStyle& style);

  std::string svg() const; ///< the whole document

  /// Roughly how wide a text is: within a tenth for DejaVu Sans.
  static double widthOf(const std::string& words, double size, bool bold);

private:
  double Width;
  double Height;
  std::string Body;
};

/// & < > and quotes as entities.
std::string escaped(const std::string& words);

/// Draws an SVG document into a PNG file, `scale` pixels for each of the drawing's. Throws std::runtime_error.
void writePng(const std::string& svg, const std::string& path, double scale);
}
}
#endif
