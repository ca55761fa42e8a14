// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file NetCDFFile.h
 * @brief A NetCDF file as plain data: its dimensions, variables and attributes, and values unpacked with what is missing as NaN.
 *
 * netCDF-C is not thread-safe: one thread at a time.
 */
#ifndef NetCDFFile_h
#define NetCDFFile_h

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace nephoscope
{
struct FileDimension
{
  std::string name;
  std::size_t size = 0;
  bool record = false; ///< unlimited
};

/// An attribute: text, or numbers with the type they are stored in.
struct FileAttribute
{
  std::string text;
  std::vector<double> numbers;
  int type = 0; ///< nc_type
};

struct FileVariable
{
  int id = -1;
  std::string name;
  int type = 0;                ///< nc_type
  std::vector<int> dimensions; ///< indices into NetCDFFile::dimensions, slowest first
  std::map<std::string, FileAttribute> attributes;

  std::string text(const std::string& attribute) const; ///< empty if not there
  bool has(const std::string& attribute) const { return this->attributes.count(attribute) != 0; }
  bool isNumeric() const;
};

class NetCDFFile
{
public:
  /// @throws ReadError if there is no such file, it is not NetCDF, or it is shorter than its header says
  explicit NetCDFFile(const std::string& path);
  ~NetCDFFile();
  NetCDFFile(const NetCDFFile&) = delete;
  NetCDFFile& operator=(const NetCDFFile&) = delete;

  const std::vector<FileDimension>& dimensions() const { return this->Dimensions; }
  const std::vector<FileVariable>& variables() const { return this->Variables; }
  const FileVariable* find(const std::string& name) const; ///< nullptr if not there
  bool globalNumber(const std::string& name, double& value) const;
  /// @throws ReadError if so many values are more than a file of this length can hold, compressed or not
  void checkSize(const FileVariable& variable, const std::vector<std::size_t>& count) const;
  std::size_t sizeOf(const FileVariable& variable, std::size_t axis) const;

  /// A hyperslab, unpacked; fill values, missing_value, values outside valid_range: NaN (masked before unpacking).
  std::vector<double> read(const FileVariable& variable, const std::vector<std::size_t>& start,
    const std::vector<std::size_t>& count) const;
  std::vector<double> readAll(const FileVariable& variable) const;
  /// A character variable as strings along its last dimension.
  std::vector<std::string> readText(const FileVariable& variable) const;

private:
  void close();
  void catalogue();

  int Id = -1;
  std::size_t FileSize = 0;
  std::vector<FileDimension> Dimensions;
  std::vector<FileVariable> Variables;
  std::map<std::string, FileAttribute> Globals;
};
}
#endif
