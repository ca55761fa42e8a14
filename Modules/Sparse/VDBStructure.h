// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VDBStructure.h
 * @brief The structure of a grid's bytes, walked before OpenVDB reads them.
 *
 * OpenVDB trusts the length of each block of values: one that is not compressed is read into its buffer before it is compared with it.
 * Here node for node what is declared is compared with what there has to be, so that OpenVDB writes nowhere else and needs memory in
 * proportion to the bytes.
 */
#ifndef VDBStructure_h
#define VDBStructure_h

#include <streambuf>
#include <string>

namespace nephoscope
{
/// Bytes to read from, which are not copied.
class ByteBuffer : public std::streambuf
{
public:
  explicit ByteBuffer(std::string& bytes)
  {
    this->setg(bytes.data(), bytes.data(), bytes.data() + bytes.size());
  }

protected:
  pos_type seekoff(off_type by, std::ios_base::seekdir from, std::ios_base::openmode) override
  {
    const off_type size = this->egptr() - this->eback();
    const off_type base = from == std::ios_base::cur ? this->gptr() - this->eback()
      : from == std::ios_base::end                   ? size
                                                     : 0;
    if (base + by < 0 || base + by > size)
    {
      return { off_type(-1) };
    }
    this->setg(this->eback(), this->eback() + base + by, this->egptr());
    return { base + by };
  }
  pos_type seekpos(pos_type to, std::ios_base::openmode mode) override
  {
    return this->seekoff(off_type(to), std::ios_base::beg, mode);
  }
};

/**
 * Check a stream of one grid: a file's prelude, the number 1, a descriptor and a tree of floats, doubles or float vectors in OpenVDB's usual
 * form. Metadata that OpenVDB would read by other lengths than are declared are renamed to a type that it does not know, and so skips.
 * @param path for messages
 * @throw VDBError for what cannot be a grid, and for frustum transforms
 */
void checkVDBStructure(const std::string& path, std::string& bytes);
}
#endif
