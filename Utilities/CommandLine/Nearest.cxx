// SPDX-License-Identifier: BSD-3-Clause
#include "Nearest.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace nephoscope::program
{
namespace
{
int folded(char c)
{
  return std::tolower(static_cast<unsigned char>(c));
}
}

std::size_t editDistance(const std::string& a, const std::string& b)
{
  // One row of the table: row[j] is the distance of the first i letters of a from the first j of b.
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{ 0 });
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (folded(a[i - 1]) == folded(b[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({ row[j] + 1, row[j - 1] + 1, replaced });
    }
  }
  return row.back();
}

std::string nearest(const std::string& word, const std::vector<std::string>& known)
{
  // A beginning, such as lat for latitude, is far in letters but near in mind.
  const auto begins = std::find_if(known.begin(), known.end(),
    [&word](const std::string& a) { return word.size() >= 3 && a.rfind(word, 0) == 0; });
  if (begins != known.end())
  {
    return *begins;
  }
  const auto best = std::min_element(known.begin(), known.end(),
    [&word](const std::string& a, const std::string& b)
    { return editDistance(word, a) < editDistance(word, b); });
  return best == known.end() ? std::string() : *best;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known)
{
  const std::string best = nearest(word, known);
  const bool begins = word.size() >= 3 && best.rfind(word, 0) == 0;
  if (begins || 2 * editDistance(word, best) <= std::max(word.size(), best.size()))
  {
    return "did you mean '" + best + "'?";
  }
  std::string all;
  for (const std::string& a : known)
  {
    all += (all.empty() ? "" : ", ") + a;
  }
  return "it can be " + all;
}
}
