// SPDX-License-Identifier: BSD-3-Clause
#include "Stability.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ostream>

namespace nephoscope
{
namespace stability
{
namespace
{
std::vector<StabilityCase>& registered()
{
  static std::vector<StabilityCase> all;
  return all;
}

using Row = std::array<std::string, 6>;

void printRows(std::ostream& out, const std::vector<Row>& rows)
{
  std::array<std::size_t, 6> widths{};
  for (const Row& row : rows)
  {
    for (std::size_t c = 0; c < row.size(); ++c)
    {
      widths[c] = std::max(widths[c], row[c].size());
    }
  }
  for (std::size_t r = 0; r < rows.size(); ++r)
  {
    for (std::size_t c = 0; c < rows[r].size(); ++c)
    {
      const bool last = c + 1 == rows[r].size();
      out << rows[r][c] << std::string(last ? 0 : widths[c] - rows[r][c].size() + 2, ' ');
    }
    out << "\n";
    if (r == 0)
    {
      for (std::size_t c = 0; c < widths.size(); ++c)
      {
        out << std::string(widths[c], '-') << (c + 1 < widths.size() ? "  " : "\n");
      }
    }
  }
}
}

const std::vector<StabilityCase>& cases()
{
  return registered();
}

StabilityRegistration::StabilityRegistration(StabilityCase stabilityCase)
{
  registered().push_back(std::move(stabilityCase));
}

int printTable(std::ostream& out)
{
  std::vector<Row> rows{ { "of", "situation", "naive", "ours", "defined answer", "holds" } };
  int failures = 0;
  for (const StabilityCase& c : cases())
  {
    const Outcome o = c.run();
    failures += o.holds ? 0 : 1;
    rows.push_back({ c.group, c.situation, o.naive, o.ours, c.defined, o.holds ? "yes" : "NO" });
  }
  printRows(out, rows);
  return failures;
}

std::string figure(const std::string& name, double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return name + " " + text;
}
}
}
