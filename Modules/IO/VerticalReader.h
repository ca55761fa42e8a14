// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VerticalReader.h
 * @brief Pressure and height of every box of a file, from whatever vertical coordinate it has.
 *
 * What the file holds as fields wins; else its coordinate; else
 *   pressure  of the US Standard Atmosphere 1976 at the height, with a warning;
 *   height    hypsometric from temperature and humidity, else of the standard atmosphere at the pressure, with a warning.
 */
#ifndef VerticalReader_h
#define VerticalReader_h

#include "CloudFile.h"
#include "FieldReader.h"

#include <map>
#include <string>
#include <vector>

namespace nephoscope
{
class VerticalReader
{
public:
  /// Also settles file.Grid.flipZ. @throws ReadError
  explicit VerticalReader(CloudFile& file);

  const std::string& kind() const { return this->Kind; }

  /// What goes in and comes out; index (k rows + j) columns + i.
  struct Fields
  {
    std::vector<float>
      temperature; ///< K; filled from potential temperature if the file has that; else empty
    std::vector<float> humidity;  ///< kg/kg or empty
    std::vector<float> pressure;  ///< Pa
    std::vector<float> height;    ///< m; finite
    std::vector<char> groundless; ///< 1 where the height had to be filled because the file masks it
  };
  void compute(const FieldReader& reader, const Region& region, Fields& fields) const;

private:
  enum class Coordinate
  {
    None,
    HybridPressure, ///< p = A + B ps; sigma coordinates as well
    LnPressure,     ///< p = A
    Pressure,       ///< p = A
    Height,         ///< z = A
    HybridHeight,   ///< z = A + B zs
    Sleve           ///< z = A + B zs1 + C zs2
  };
  using Terms = std::map<std::string, std::string>;

  bool fromFormula(CloudFile& file);
  bool fromHybridNames(CloudFile& file);
  bool fromAxis(CloudFile& file);
  bool fromAxis(CloudFile& file, const FileVariable& axis);
  void readTerms(
    CloudFile& file, const FileVariable& owner, const std::string& standard, const Terms& terms);
  void readPressureTerms(CloudFile& file, const FileVariable& owner, const Terms& terms);
  void readSigmaTerms(CloudFile& file, const FileVariable& owner, const Terms& terms);
  void readHeightTerms(CloudFile& file, const FileVariable& owner, const Terms& terms, bool sleve);
  void setSurface(CloudFile& file, const FileVariable& owner, const std::string& name,
    const char* units, int which);
  void alignWithAxis(CloudFile& file, const FileVariable& owner);
  bool findSurfacePressure(CloudFile& file, const std::string& wantedBy);
  void findDirection(CloudFile& file);
  void describe(CloudFile& file) const;
  std::vector<double> nominal() const;
  bool isPressure() const;
  std::vector<float> pressureOf(const FieldReader& reader, const Region& region) const;
  std::vector<float> heightOf(const FieldReader& reader, const Region& region) const;
  void hypsometric(const FieldReader& reader, const Region& region, Fields& fields) const;
  void fillHeights(const Region& region, Fields& fields) const;

  CloudFile& File;
  Coordinate Form = Coordinate::None;
  std::string Kind;
  std::vector<double> A; ///< per level; file order until the direction is known, then lowest first
  std::vector<double> B;
  std::vector<double> C;
  RoleVariable Surface[2]; ///< ps, or zs1 and zs2
  bool LogSurface = false; ///< Surface[0] is ln(ps)
};
}
#endif
