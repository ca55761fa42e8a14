// SPDX-License-Identifier: BSD-3-Clause
// Files with bytes changed at random: each is read or refused, in little memory. Children of this process read them, so that a crash
// is counted, not shared.
#include "SparseTesting.h"
#include "vtkCloudVDBWriter.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <random>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace sparse_testing;

// A length that was mutated is an allocation that fails, not the end of the process.
// NOLINTBEGIN(bugprone-reserved-identifier): the name that AddressSanitizer asks for
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options()
// NOLINTEND(bugprone-reserved-identifier)
{
  return "allocator_may_return_null=1";
}

namespace
{
#ifdef __SANITIZE_ADDRESS__
constexpr int Mutants = 300; // ten times slower
#else
constexpr int Mutants = 2000;
#endif

std::string bytesOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

/// One to four changes: a byte, a length of 4 bytes, a piece that is cut out, the end cut off. The first kB, where all lengths that matter
/// stand, is hit as often as all the rest.
std::string mutated(std::string bytes, unsigned seed)
{
  std::mt19937 random(seed);
  const auto below = [&random](std::size_t n) { return random() % n; };
  for (std::size_t change = 0; change <= below(4); ++change)
  {
    const std::size_t at = below(2) != 0U ? below(std::min<std::size_t>(2000, bytes.size() - 8))
                                          : below(bytes.size() - 8);
    switch (below(8))
    {
      case 0:
        bytes.replace(at, 4, std::string("\xff\xff\xff\x7f", 4));
        break;
      case 1:
        bytes.erase(at, 1 + below(16));
        break;
      case 2:
        bytes.resize(std::max<std::size_t>(at, 16));
        break;
      default:
        bytes[at] = static_cast<char>(random());
    }
    if (bytes.size() < 32)
    {
      break;
    }
  }
  return bytes;
}

/// Reads mutants from `first` on, and tells of each through the pipe: r read, e refused with a line, s silent.
[[noreturn]] void readMutants(const Folder& folder, const std::string& bytes, int first, int pipe)
{
  for (int m = first; m < Mutants; ++m)
  {
    const std::string path = folder.file("mutant.vdb");
    std::ofstream(path, std::ios::binary) << mutated(bytes, static_cast<unsigned>(m));
    ::alarm(20); // one that never ends counts as a crash
    const Read read =
      readAs(m % 2 ? vtkCloudVDBReader::Bricks : vtkCloudVDBReader::Image, path, "", 1e7);
    auto* const data = vtkDataSet::SafeDownCast(read.data);
    const bool made = data && data->GetNumberOfPoints() > 0;
    const char told = made ? 'r' : read.said.empty() ? 's' : 'e';
    if (::write(pipe, &told, 1) != 1)
    {
      break;
    }
  }
  ::_exit(0);
}

/// What a child made of mutants from `first` on, until it ended.
std::string fates(const Folder& folder, const std::string& bytes, int first)
{
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0)
  {
    ::close(ends[0]);
    std::set_terminate([] { ::_exit(1); });
    [&]() noexcept { readMutants(folder, bytes, first, ends[1]); }();
  }
  ::close(ends[1]);
  std::string told;
  char letter = 0;
  while (::read(ends[0], &letter, 1) == 1)
  {
    told += letter;
  }
  ::close(ends[0]);
  int status = 0;
  struct rusage used = {};
  ::wait4(child, &status, 0, &used);
#ifndef __SANITIZE_ADDRESS__
  // A file of 60 kB may need 40 times as much, and makes 1e7 voxels at most.
  EXPECT_LT(used.ru_maxrss, 400 * 1024); // kB
#endif
  return told;
}
}

TEST(CloudVDBMutations, AreReadOrRefused)
{
  const Folder folder;
  vtkNew<vtkCloudVDBWriter> writer;
  writer->SetInputData(blob());
  writer->SetFileName(folder.file("blob.vdb").c_str());
  ASSERT_EQ(writer->Write(), 1);
  const std::string bytes = bytesOf(folder.file("blob.vdb"));
  int read = 0;
  int refused = 0;
  int crashed = 0;
  int done = 0;
  while (done < Mutants)
  {
    const std::string told = fates(folder, bytes, done);
    for (const char letter : told)
    {
      EXPECT_NE(letter, 's') << "mutant " << done << " gives nothing and says nothing";
      read += letter == 'r';
      refused += letter == 'e';
      ++done;
    }
    if (done < Mutants)
    {
      std::printf("mutant %d ends the process\n", done);
      ++crashed;
      ++done;
    }
  }
  std::printf("%d read, %d refused, %d crashed\n", read, refused, crashed);
  EXPECT_GT(read, Mutants / 20);
  EXPECT_GT(refused, Mutants / 20);
  EXPECT_EQ(crashed, 0);
}
