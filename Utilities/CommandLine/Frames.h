// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Frames.h
 * @brief A folder of numbered pictures that several processes fill, and the film of them.
 */
#ifndef Frames_h
#define Frames_h

#include <string>

namespace nephoscope::program
{
/// A folder with frame-0000.png and so on, each there and complete or not there.
class Frames
{
public:
  /// Nothing is written yet. @throw Failure if the folder is something else
  Frames(const std::string& folder, int number, const std::string& description);

  /// Whether the folder says already what its frames are of.
  bool isBegun() const;

  /**
   * Makes the folder if there is none, and keeps in its animation.txt what the frames are of.
   * @throw Failure if the folder holds frames of another description, or cannot be written
   */
  void begin() const;

  std::string path(int frame) const;
  bool has(int frame) const;
  int missing() const; ///< number of frames that are not there
  const std::string& folder() const { return this->Folder; }

private:
  std::string note() const { return this->Folder + "/animation.txt"; }

  std::string Folder;
  int Number;
  std::string Description;
};

/// The right to draw a frame, as long as the object lives: of all processes one has it. It ends with the process, however that ends.
class FrameClaim
{
public:
  FrameClaim(const Frames& frames, int frame);
  ~FrameClaim();
  FrameClaim(const FrameClaim&) = delete;
  FrameClaim& operator=(const FrameClaim&) = delete;

  /// Whether the frame is to be drawn: it is not there, and nobody else draws it.
  bool isMine() const { return this->Mine; }

private:
  std::string Lock;
  int Descriptor = -1;
  bool Locked = false;
  bool Mine = false;
};

/// movie.mp4 in the folder, by ffmpeg; without it, says on standard error what to run. @throw Failure if ffmpeg fails
void makeMovie(const Frames& frames, double framesPerSecond);
}
#endif
