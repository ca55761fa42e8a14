// SPDX-License-Identifier: BSD-3-Clause
#include "ClassicHeader.h"

#include "ReadError.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <vector>

namespace nephoscope
{
namespace
{
constexpr std::uint64_t DimensionTag = 0xA;
constexpr std::uint64_t VariableTag = 0xB;
constexpr std::uint64_t AttributeTag = 0xC;

class Walker
{
public:
  Walker(const std::string& path, std::size_t fileSize)
    : In(path, std::ios::binary)
    , FileSize(fileSize)
  {
  }

  void check()
  {
    char magic[4] = {};
    this->In.read(magic, 4);
    const char version = magic[3];
    if (!this->In || magic[0] != 'C' || magic[1] != 'D' || magic[2] != 'F' ||
      (version != 1 && version != 2 && version != 5))
    {
      return;
    }
    this->At = 4;
    this->CountBytes = version == 5 ? 8 : 4;
    this->OffsetBytes = version == 1 ? 4 : 8;
    const std::uint64_t records = this->number(this->CountBytes);
    // All ones: a stream whose records netCDF-C counts from the length of the file.
    this->Streamed = records == (this->CountBytes == 8 ? ~std::uint64_t(0) : 0xFFFFFFFF);
    this->Records = static_cast<double>(records);
    this->dimensions();
    this->attributes();
    this->variables();
    this->checkLength();
  }

private:
  [[noreturn]] void damaged(const char* what) const
  {
    throw ReadError(std::string("its header is damaged (") + what + " at byte " +
      std::to_string(this->At) + "), or the file is cut short; fetch it again");
  }

  std::uint64_t number(int bytes)
  {
    unsigned char raw[8] = {};
    this->In.read(reinterpret_cast<char*>(raw), bytes);
    if (!this->In)
    {
      this->damaged("it ends");
    }
    this->At += static_cast<std::size_t>(bytes);
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i)
    {
      value = value << 8 | raw[i];
    }
    return value;
  }

  /// A count of things of at least so many bytes each, which must fit into the rest of the file.
  std::uint64_t count(std::uint64_t bytesEach, const char* what)
  {
    const std::uint64_t n = this->number(this->CountBytes);
    if (n > (this->FileSize - this->At) / bytesEach)
    {
      this->damaged(what);
    }
    return n;
  }

  void skip(std::uint64_t bytes, const char* what)
  {
    const std::uint64_t padded = (bytes + 3) / 4 * 4;
    if (padded > this->FileSize - this->At)
    {
      this->damaged(what);
    }
    this->In.seekg(static_cast<std::streamoff>(padded), std::ios::cur);
    this->At += padded;
  }

  std::uint64_t list(std::uint64_t tag, std::uint64_t bytesEach, const char* what)
  {
    const std::uint64_t found = this->number(4);
    const std::uint64_t n = this->count(bytesEach, what);
    if (found != tag && (found != 0 || n != 0))
    {
      this->damaged(what);
    }
    return n;
  }

  std::uint64_t typeSize(const char* what)
  {
    static const std::uint64_t sizes[] = { 0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8 };
    const std::uint64_t type = this->number(4);
    if (type < 1 || type > 11)
    {
      this->damaged(what);
    }
    return sizes[type];
  }

  void name() { this->skip(this->count(1, "a name"), "a name"); }

  void dimensions()
  {
    const std::uint64_t each = 2 * static_cast<std::uint64_t>(this->CountBytes);
    for (std::uint64_t n = this->list(DimensionTag, each, "the dimensions"); n > 0; --n)
    {
      this->name();
      this->Lengths.push_back(this->number(this->CountBytes));
    }
  }

  void attributes()
  {
    const std::uint64_t each = 4 + 2 * static_cast<std::uint64_t>(this->CountBytes);
    for (std::uint64_t n = this->list(AttributeTag, each, "the attributes"); n > 0; --n)
    {
      this->name();
      const std::uint64_t size = this->typeSize("the type of an attribute");
      this->skip(size * this->count(size, "an attribute"), "an attribute");
    }
  }

  void variables()
  {
    const std::uint64_t each = 12 + 3 * static_cast<std::uint64_t>(this->CountBytes);
    for (std::uint64_t n = this->list(VariableTag, each, "the variables"); n > 0; --n)
    {
      this->name();
      const std::uint64_t rank =
        this->count(static_cast<std::uint64_t>(this->CountBytes), "the dimensions of a variable");
      double values = 1;
      bool record = false;
      for (std::uint64_t d = 0; d < rank; ++d)
      {
        const std::uint64_t id = this->number(this->CountBytes);
        if (id >= this->Lengths.size() || (this->Lengths[id] == 0 && d > 0))
        {
          this->damaged("the dimensions of a variable");
        }
        record = record || this->Lengths[id] == 0;
        values *= this->Lengths[id] == 0 ? 1.0 : static_cast<double>(this->Lengths[id]);
      }
      this->attributes();
      const double bytes = values * static_cast<double>(this->typeSize("the type of a variable"));
      this->number(this->CountBytes); // vsize is redundant
      this->Places.push_back(
        { static_cast<double>(this->number(this->OffsetBytes)), bytes, record });
    }
  }

  void checkLength() const
  {
    double recordBytes = 0;
    std::size_t recordVariables = 0;
    for (const Place& place : this->Places)
    {
      recordVariables += place.record ? 1 : 0;
    }
    for (const Place& place : this->Places)
    {
      const double rest = recordVariables > 1 ? 4 * std::ceil(place.bytes / 4) - place.bytes : 0;
      recordBytes += place.record ? place.bytes + rest : 0;
    }
    double promised = 0;
    for (const Place& place : this->Places)
    {
      const bool none = place.record && (this->Streamed || this->Records < 1);
      const double end =
        place.begin + (place.record ? (this->Records - 1) * recordBytes : 0) + place.bytes;
      promised = none ? promised : std::max(promised, end);
    }
    if (promised > static_cast<double>(this->FileSize))
    {
      throw ReadError("it is cut short: it has " + std::to_string(this->FileSize) +
        " bytes, and its header promises more; fetch it again");
    }
  }

  struct Place
  {
    double begin;
    double bytes; ///< of one record, or of all
    bool record;
  };
  std::ifstream In;
  std::size_t FileSize;
  std::size_t At = 0;
  int CountBytes = 4;
  int OffsetBytes = 4;
  bool Streamed = false;
  double Records = 0;
  std::vector<std::uint64_t> Lengths;
  std::vector<Place> Places;
};
}

void checkClassicHeader(const std::string& path, std::size_t fileSize)
{
  Walker(path, fileSize).check();
}
}
