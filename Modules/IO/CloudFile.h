// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CloudFile.h
 * @brief What a file holds for the reader: the variable of each role, the grid they share, and the times.
 */
#ifndef CloudFile_h
#define CloudFile_h

#include "CFTime.h"
#include "CloudRoles.h"
#include "FileAxes.h"
#include "NetCDFFile.h"
#include "Units.h"

#include <map>
#include <string>
#include <vector>

namespace nephoscope
{
/// A variable in its role, and how its values become those of the role.
struct RoleVariable
{
  const FileVariable* variable = nullptr;
  UnitConversion conversion;
  bool chosen = false;   ///< by the user
  bool unitless = false; ///< has no units: taken for those of the role
};

class CloudFile
{
public:
  /// @param choices role to variable name; an empty name means none
  /// @throws ReadError
  CloudFile(const std::string& path, const std::map<Role, std::string>& choices);

  const RoleVariable* find(Role role) const; ///< nullptr if the file has none
  const FileVariable& master() const { return *this->Master; }
  bool isWRF() const { return this->WRF; }
  /// The 1-D variable or another by name; throws ReadError that names who wants it.
  const FileVariable& require(const std::string& name, const std::string& wantedBy) const;
  /// Whether the variable lies on the grid, staggered by half a box or not; with or without the vertical.
  bool liesOnGrid(const FileVariable& variable, bool vertical) const;
  void warn(const std::string& text);
  void derive(const std::string& text) { this->Derivations.push_back(text); }

  NetCDFFile File;
  FileAxes Axes;
  GridAxes Grid;
  TimeAxis Clock;
  std::vector<double> Times; ///< seconds since the reference, ascending
  bool HasClock = false;
  std::vector<std::string> Derivations;
  std::vector<std::string> Warnings;

private:
  void findMaster();
  void layAxes();
  void findRoles();
  void checkBaseStates();
  void findTimes();
  bool findWrittenTimes(std::size_t steps);
  bool chosenName(Role role, std::string& name) const;
  std::vector<const FileVariable*> candidates(Role role) const;
  bool suits(const FileVariable& variable, Role role) const;
  RoleVariable take(const FileVariable& variable, Role role, bool chosen) const;
  bool unitsFit(const FileVariable& variable, Role role) const;
  std::string fieldNames() const;

  std::map<Role, std::string> Choices;
  std::map<Role, RoleVariable> Variables;
  const FileVariable* Master = nullptr;
  Role MasterRole = Role::CloudFraction;
  bool WRF = false;
};
}
#endif
