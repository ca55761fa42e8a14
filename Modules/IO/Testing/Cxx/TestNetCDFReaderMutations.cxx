// SPDX-License-Identifier: BSD-3-Clause
// Hostile input: 2,400 damaged files, each read to the end. Whatever the damage, the reader reads or refuses in one line.
//
// The files are read in child processes, so that a crash costs one file and is seen. A crash is the reader's unless plain
// netCDF-C calls (open, list everything, read every variable, close) on the same file crash too: then it is the library's,
// which no caller can prevent, and is counted apart.
#include "SmallFile.h"

#include <netcdf.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <random>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
constexpr int PerSeed = 600;      // mutations of each of four seeds
constexpr unsigned Patience = 20; // seconds that one file may take

std::string bytesOf(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>() };
}

/// A hybrid-level file of 4 x 3 columns, packed, with time.
std::string seedHybrid(int format)
{
  SmallFile file(format);
  file.dimension("time", NC_UNLIMITED).dimension("lev", 3).dimension("lat", 3).dimension("lon", 4);
  file.variable("lon", { "lon" }, { 0, 90, 180, 270 }, { { "units", "degrees_east" } });
  file.variable("lat", { "lat" }, { 60, 0, -60 }, { { "units", "degrees_north" } });
  file.variable("hyam", { "lev" }, { 0.1, 0.1, 0.0 });
  file.variable("hybm", { "lev" }, { 0.0, 0.4, 1.0 });
  file.variable("P0", {}, { 1e5 }, { { "units", "Pa" } });
  file.variable("PS", { "lat", "lon" }, std::vector<double>(12, 1e5), { { "units", "Pa" } });
  file.variable("T", { "lev", "lat", "lon" }, std::vector<double>(36, 260), { { "units", "K" } });
  file.variable("CLOUD", { "lev", "lat", "lon" }, std::vector<double>(36, 50), { { "units", "%" } },
    NC_SHORT, { { "scale_factor", 0.5 }, { "_FillValue", -1 } });
  return bytesOf(file.path());
}

/// Two-dimensional longitudes, hybrid height by formula_terms.
std::string seedCurvilinear(int format)
{
  SmallFile file(format);
  file.dimension("z", 3).dimension("y", 3).dimension("x", 2);
  file.variable("lon", { "y", "x" }, { 0, 1, 0, 1, 0, 1 }, { { "units", "degrees_east" } });
  file.variable("lat", { "y", "x" }, { 0, 0, 1, 1, 2, 2 }, { { "units", "degrees_north" } });
  file.variable("z", { "z" }, { 10, 100, 500 },
    { { "units", "m" }, { "standard_name", "atmosphere_hybrid_height_coordinate" },
      { "formula_terms", "a: z b: b orog: orog" } });
  file.variable("b", { "z" }, { 1, 0.5, 0 });
  file.variable("orog", { "y", "x" }, std::vector<double>(6, 100), { { "units", "m" } });
  file.variable(
    "cl", { "z", "y", "x" }, std::vector<double>(18, 0.5), { { "units", "1" } }, NC_FLOAT);
  return bytesOf(file.path());
}

std::string mutated(const std::string& seed, std::mt19937& random)
{
  std::string bytes = seed;
  const auto pick = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  switch (random() % 5)
  {
    case 0: // cut
      bytes.resize(pick(bytes.size()));
      break;
    case 1: // one extreme word, on a word boundary
    {
      static const unsigned char extremes[4][4] = { { 255, 255, 255, 255 }, { 127, 255, 255, 255 },
        { 0, 0, 0, 0 }, { 128, 0, 0, 0 } };
      const std::size_t place = 4 * pick(bytes.size() / 4);
      std::memcpy(&bytes[place], extremes[random() % 4], 4);
      break;
    }
    case 2: // a block over another
    {
      const std::size_t n = 1 + pick(64);
      if (bytes.size() > 2 * n)
      {
        const std::string block = bytes.substr(pick(bytes.size() - n), n);
        bytes.replace(pick(bytes.size() - n), n, block);
      }
      break;
    }
    default: // 1 to 8 bytes
      for (std::size_t n = 1 + pick(8); n > 0; --n)
      {
        bytes[pick(bytes.size())] = static_cast<char>(random());
      }
  }
  return bytes;
}

void readWithReader(const std::string& path)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(path.c_str());
  reader->DiagnoseCloudFractionOn();
  const std::string message = messageOf(reader);
  if (message.find('\n') != std::string::npos)
  {
    std::fprintf(stderr, "message of more than one line: %s\n", message.c_str());
    std::abort();
  }
}

void readWithLibrary(const std::string& path)
{
  int id = 0;
  if (nc_open(path.c_str(), NC_NOWRITE, &id) != NC_NOERR)
  {
    return;
  }
  int dimensions = 0;
  int variables = 0;
  int attributes = 0;
  if (nc_inq(id, &dimensions, &variables, &attributes, nullptr) == NC_NOERR)
  {
    for (int v = -1; v < variables; ++v)
    {
      char name[NC_MAX_NAME + 1];
      int rank = 0;
      int own = v < 0 ? attributes : 0;
      int ids[NC_MAX_VAR_DIMS];
      nc_type type = 0;
      if (v >= 0 && nc_inq_var(id, v, name, &type, &rank, ids, &own) != NC_NOERR)
      {
        continue;
      }
      for (int a = 0; a < own; ++a)
      {
        std::size_t length = 0;
        if (nc_inq_attname(id, v, a, name) == NC_NOERR &&
          nc_inq_att(id, v, name, &type, &length) == NC_NOERR && length < 4096)
        {
          std::vector<double> numbers(length + 1);
          std::vector<char> text(length + 1);
          type == NC_CHAR ? nc_get_att_text(id, v, name, text.data())
                          : nc_get_att_double(id, v, name, numbers.data());
        }
      }
      std::vector<std::size_t> start(static_cast<std::size_t>(rank) + 1, 0);
      std::vector<std::size_t> count(static_cast<std::size_t>(rank) + 1, 1);
      double total = 1;
      for (int d = 0; d < rank; ++d)
      {
        nc_inq_dimlen(id, ids[d], &count[static_cast<std::size_t>(d)]);
        total *= static_cast<double>(count[static_cast<std::size_t>(d)]);
      }
      if (v >= 0 && total < 1e6)
      {
        std::vector<double> values(static_cast<std::size_t>(total) + 1);
        nc_get_vara_double(id, v, start.data(), count.data(), values.data());
      }
    }
  }
  nc_close(id);
}

/// Runs work(index) for first..last in a child; returns the index at which the child died, or last.
template <class Work>
int inChild(int first, int last, const Work& work)
{
  int report[2];
  if (pipe(report) != 0)
  {
    ADD_FAILURE() << "no pipe";
    return last;
  }
  const pid_t child = fork();
  if (child == 0)
  {
    close(report[0]);
    const int null = ::open("/dev/null", O_WRONLY);
    const bool quiet = std::getenv("NEPHOSCOPE_MUTATIONS_VERBOSE") == nullptr;
    if (quiet)
    {
      dup2(null, 2);
    }
    for (int index = first; index < last; ++index)
    {
      if (write(report[1], &index, sizeof(index)) != sizeof(index))
      {
        _exit(3);
      }
      alarm(Patience);
      work(index);
    }
    _exit(0);
  }
  close(report[1]);
  int index = first;
  int seen = first;
  while (read(report[0], &index, sizeof(index)) == sizeof(index))
  {
    seen = index;
  }
  close(report[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? last : seen;
}

/// The seed's mutations: file index to bytes, the same in every process.
std::string mutation(const std::string& seed, int seedNumber, int index)
{
  std::mt19937 random(static_cast<unsigned>(1000003 * seedNumber + index));
  return mutated(seed, random);
}

void survives(const std::string& seed, int seedNumber)
{
  const std::string path = (std::filesystem::temp_directory_path() /
    ("nephoscope-mutation-" + std::to_string(getpid()) + ".nc"))
                             .string();
  const auto make = [&](int index)
  { std::ofstream(path, std::ios::binary | std::ios::trunc) << mutation(seed, seedNumber, index); };
  int library = 0;
  for (int next = 0; next < PerSeed;)
  {
    const int died = inChild(next, PerSeed,
      [&](int index)
      {
        make(index);
        readWithReader(path);
      });
    if (died < PerSeed)
    {
      make(died);
      const bool own = inChild(0, 1, [&](int) { readWithLibrary(path); }) == 1;
      EXPECT_FALSE(own) << "the reader died on mutation " << died << " of seed " << seedNumber;
      library += own ? 0 : 1;
    }
    next = died + 1;
  }
  std::filesystem::remove(path);
  ::testing::Test::RecordProperty("library_crashes", library);
  if (library)
  {
    std::printf("%d of %d files crash netCDF-C or HDF5 themselves\n", library, PerSeed);
  }
}
}

TEST(NetCDFReaderMutations, SeedsAreRead)
{
  for (const int format : { 0, NC_NETCDF4 | NC_CLASSIC_MODEL })
  {
    for (const std::string& seed : { seedHybrid(format), seedCurvilinear(format) })
    {
      const std::string path = (std::filesystem::temp_directory_path() /
        ("nephoscope-seed-" + std::to_string(getpid()) + ".nc"))
                                 .string();
      std::ofstream(path, std::ios::binary) << seed;
      // In a child as well: a process that has run threads must not fork readers.
      const int read = inChild(0, 1,
        [&path](int)
        {
          vtkNew<vtkCloudNetCDFReader> reader;
          reader->SetFileName(path.c_str());
          const bool good =
            messageOf(reader).empty() && reader->GetOutput()->GetNumberOfPoints() > 0;
          _exit(good ? 0 : 4);
        });
      EXPECT_EQ(read, 1);
      std::filesystem::remove(path);
    }
  }
}

TEST(NetCDFReaderMutations, Classic)
{
  survives(seedHybrid(0), 1);
}

TEST(NetCDFReaderMutations, ClassicCurvilinear)
{
  survives(seedCurvilinear(NC_64BIT_OFFSET), 2);
}

TEST(NetCDFReaderMutations, NetCDF4)
{
  survives(seedHybrid(NC_NETCDF4 | NC_CLASSIC_MODEL), 3);
}

TEST(NetCDFReaderMutations, NetCDF4Curvilinear)
{
  survives(seedCurvilinear(NC_NETCDF4), 4);
}
