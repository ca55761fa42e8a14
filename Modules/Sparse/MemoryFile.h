// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file MemoryFile.h
 * @brief A file in memory to write to, in blocks that are never moved.
 */
#ifndef MemoryFile_h
#define MemoryFile_h

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <ostream>
#include <streambuf>
#include <sys/mman.h>
#include <vector>

namespace nephoscope
{
/// What a std::ostream writes to, places of which can be sought and written again.
class MemoryFile : public std::streambuf
{
public:
  static constexpr std::size_t Block = std::size_t{ 4 } << 20; ///< bytes

  /// @param grown called before each block, with its size; what it throws reaches who writes
  explicit MemoryFile(std::function<void(std::size_t)> grown)
    : Grown(std::move(grown))
  {
  }

  /// What stands from a byte on.
  void copyTo(std::ostream& stream, std::size_t from) const
  {
    while (from < this->Size)
    {
      const std::size_t part = std::min(this->Size - from, Block - from % Block);
      stream.write(this->Blocks[from / Block].get() + from % Block, static_cast<long>(part));
      from += part;
    }
  }

protected:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override
  {
    for (auto left = static_cast<std::size_t>(count); left > 0;)
    {
      if (this->At / Block == this->Blocks.size())
      {
        this->addBlock();
      }
      const std::size_t part = std::min(left, Block - this->At % Block);
      std::memcpy(this->Blocks[this->At / Block].get() + this->At % Block, bytes, part);
      bytes += part;
      left -= part;
      this->At += part;
      this->Size = std::max(this->Size, this->At);
    }
    return count;
  }

  int_type overflow(int_type letter) override
  {
    const char byte = traits_type::to_char_type(letter);
    this->xsputn(&byte, 1);
    return letter;
  }

  pos_type seekoff(off_type by, std::ios_base::seekdir from, std::ios_base::openmode) override
  {
    const std::size_t base = from == std::ios_base::cur ? this->At
      : from == std::ios_base::end                      ? this->Size
                                                        : 0;
    const off_type to = static_cast<off_type>(base) + by;
    if (to < 0 || to > static_cast<off_type>(this->Size))
    {
      return { off_type(-1) };
    }
    this->At = static_cast<std::size_t>(to);
    return { to };
  }

  pos_type seekpos(pos_type to, std::ios_base::openmode mode) override
  {
    return this->seekoff(off_type(to), std::ios_base::beg, mode);
  }

private:
  struct Free
  {
    void operator()(char* block) const { std::free(block); }
  };

  /// In large pages, where the system has them: the first touch of small ones takes longer than writing.
  void addBlock()
  {
    this->Grown(Block);
    constexpr std::size_t LargePage = std::size_t{ 2 } << 20;
    std::unique_ptr<char, Free> block(static_cast<char*>(std::aligned_alloc(LargePage, Block)));
    if (!block)
    {
      throw std::bad_alloc();
    }
    ::madvise(block.get(), Block, MADV_HUGEPAGE);
    this->Blocks.push_back(std::move(block));
  }

  std::function<void(std::size_t)> Grown;
  std::vector<std::unique_ptr<char, Free>> Blocks;
  std::size_t At = 0;   ///< where is written next
  std::size_t Size = 0; ///< bytes
};
}
#endif
