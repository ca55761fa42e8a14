// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Nearest.h
 * @brief The known word that a mistyped one was most likely meant to be.
 */
#ifndef Nearest_h
#define Nearest_h

#include <cstddef>
#include <string>
#include <vector>

namespace nephoscope::program
{
/// Levenshtein's distance: insertions, deletions and replacements of a character, letters compared without case.
std::size_t editDistance(const std::string& a, const std::string& b);

/// The word of a list at the least edit distance, the first of several; empty if the list is.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// "did you mean 'volume'?", or "it can be surface, texture, volume" where no word is nearer than half the letters.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);
}
#endif
