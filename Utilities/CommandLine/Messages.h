// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Messages.h
 * @brief What VTK's classes have to say, turned into lines for the user.
 */
#ifndef Messages_h
#define Messages_h

#include <string>
#include <vector>

namespace nephoscope::program
{
/**
 * @brief Collects errors and warnings of all VTK classes from install() on, from any thread, instead of printing them.
 *
 * A message is one line without the source's path, the class and its address.
 */
class Messages
{
public:
  /// Call once, before any pipeline runs.
  static void install();

  /// @throw Failure with the first error, the cause of the others, after the name of what was worked on
  static void throwIfError(const std::string& subject);

  /// The warnings since the last call, each once.
  static std::vector<std::string> takeWarnings();

  /// Print the warnings since the last call on standard error.
  static void printWarnings();
};

/// "ERROR: In path, line 7\nvtkFoo (0x1): what happened\n" as "what happened".
std::string bareMessage(const std::string& text);

/// A text that is one line: of 2000 characters at most, with '?' for control characters, which names and keys may hold.
std::string printable(const std::string& text);

/// Print one line for the user on standard error: "nephoscope: " and the text.
void note(const std::string& text);
}
#endif
