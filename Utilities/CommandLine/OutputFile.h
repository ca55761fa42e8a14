// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file OutputFile.h
 * @brief A file that appears whole or not at all.
 */
#ifndef OutputFile_h
#define OutputFile_h

#include <string>
#include <vector>

namespace nephoscope::program
{
/**
 * @brief Written under another name in the same folder, renamed when it is complete.
 *
 * A failure before commit() removes what was written. An interrupt waits until the object is destroyed, and then ends the
 * program with the file whole or not there. One object at a time.
 */
class OutputFile
{
public:
  /// @throw Failure if the folder does not exist or the path is something other than a regular file
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Where to write; it has the extension of the final name.
  const std::string& partial() const { return this->Partial; }

  /// Whether an interrupt waits: what is written is not wanted any more.
  static bool isInterrupted();

  /// Give the complete file its name. @throw Failure if it cannot be renamed or was not written
  void commit();

private:
  std::string Path;
  std::string Partial;
};

/**
 * What OutputFile would throw, before there is anything to write.
 * @throw UsageFailure if the file is one of `others`, which the command reads or writes too
 */
void checkWritable(const std::string& path, const std::vector<std::string>& others = {});

/// The lower-case extension of a path without its dot; empty if there is none.
std::string extensionOf(const std::string& path);

/// Write a text under a name, whole or not at all.
void writeText(const std::string& path, const std::string& text);

/// From now on SIGINT, SIGTERM and SIGHUP say one line and end the program with 128 + the signal's number, and a file that
/// grows beyond the shell's limit is one that cannot be written.
void handleInterrupts();
}
#endif
