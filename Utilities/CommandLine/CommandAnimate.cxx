// SPDX-License-Identifier: BSD-3-Clause
// nephoscope animate: a scene as numbered pictures, by one process or several, and as a film.
#include "Commands.h"
#include "Failure.h"
#include "Frames.h"
#include "Messages.h"
#include "MovingScene.h"
#include "PictureFile.h"
#include "Progress.h"
#include "SceneFile.h"

#include <CLI/CLI.hpp>
#include <vtkCloudscape.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>

namespace nephoscope::program
{
namespace
{
struct AnimateOptions
{
  std::string scene;
  std::string folder;
  int frames = 96;
  double rate = 24;
  std::optional<std::string> from;
  std::optional<std::string> to;
  std::optional<std::string> size;
  bool movie = false;
};

/// What the frames of a folder are of: those of another animation are not mixed with them.
std::string descriptionOf(const AnimateOptions& options, const Picture& picture)
{
  std::ifstream scene(options.scene, std::ios::binary);
  std::ostringstream text;
  text << "# " << options.frames << " frames of " << picture.size[0] << 'x' << picture.size[1]
       << " from " << options.from.value_or("the first time") << " to "
       << options.to.value_or("the last time") << " of this scene:\n"
       << scene.rdbuf();
  return text.str();
}

std::string timeText(double seconds)
{
  char text[32];
  const int minutes = static_cast<int>(seconds / 60);
  std::snprintf(text, sizeof(text), "%d:%02d", minutes, static_cast<int>(seconds) % 60);
  return text;
}

/// Draws what is missing; other processes may draw in the same folder.
class Artist
{
public:
  Artist(const AnimateOptions& options, const Scene& scene, const Frames& frames)
    : Options(options)
    , Parts(scene)
    , Pictures(frames)
  {
  }

  /// What is wrong with the scene is said before the folder is made.
  void prepare()
  {
    if (!this->Moving)
    {
      this->Moving = std::make_unique<MovingScene>(
        this->Parts, this->Options.from, this->Options.to, this->Watch);
    }
  }

  void drawAll()
  {
    for (int frame = 0; frame < this->Options.frames; ++frame)
    {
      const FrameClaim claim(this->Pictures, frame);
      if (claim.isMine())
      {
        this->draw(frame);
      }
    }
  }

  int drawn() const { return this->Drawn; }

private:
  void draw(int frame)
  {
    this->prepare();
    const int steps = this->Options.frames - (this->Parts.animation.cycle ? 0 : 1);
    const double moment = steps > 0 ? static_cast<double>(frame) / steps : 0;
    const BuiltScene built = this->Moving->at(moment);
    built.scape->ComputeDepthOff(); // a PNG has none
    this->Watch.watch(built.scape, this->label(frame));
    built.scape->Update();
    this->Watch.forget();
    Messages::throwIfError(this->Parts.subject());
    Messages::printWarnings();
    writePicture(built.scape, this->Parts.picture.exposure, this->Pictures.path(frame));
    this->Seconds += this->Clock.lap();
    ++this->Drawn;
  }

  std::string label(int frame) const
  {
    std::string text =
      "frame " + std::to_string(frame + 1) + "/" + std::to_string(this->Options.frames);
    if (this->Drawn > 0)
    {
      const int left = this->Pictures.missing();
      text += ", " + timeText(left * this->Seconds / this->Drawn) + " left";
    }
    return text;
  }

  const AnimateOptions& Options;
  const Scene& Parts;
  const Frames& Pictures;
  Progress Watch;
  Stopwatch Clock;
  std::unique_ptr<MovingScene> Moving;
  double Seconds = 0;
  int Drawn = 0;
};

void runAnimate(const AnimateOptions& options)
{
  Scene scene = readScene(options.scene);
  if (options.size)
  {
    scene.picture.size = sizeOf(*options.size);
  }
  if (scene.data.file.empty() && (options.from || options.to))
  {
    throw UsageFailure("--from and --to are of data, and " + options.scene + " has none");
  }
  Frames frames(options.folder, options.frames, descriptionOf(options, scene.picture));
  Artist artist(options, scene, frames);
  if (!frames.isBegun())
  {
    artist.prepare();
  }
  frames.begin();
  artist.drawAll();
  const int missing = frames.missing();
  note(options.folder + ": " + std::to_string(options.frames) +
    (options.frames == 1 ? " frame, " : " frames, ") + std::to_string(artist.drawn()) +
    " of them drawn now" +
    (missing ? ", " + std::to_string(missing) + " still being drawn by other processes" : ""));
  if (options.movie && missing == 0)
  {
    makeMovie(frames, options.rate);
  }
}
}

void addAnimate(CLI::App& app)
{
  auto options = std::make_shared<AnimateOptions>();
  CLI::App* const command = app.add_subcommand(
    "animate", "Draw a scene as an animation: clouds and their textures move with the wind.");
  command->add_option("scene", options->scene, "scene file (YAML)")
    ->type_name("SCENE.yaml")
    ->required();
  command
    ->add_option("-o,--output", options->folder,
      "folder for frame-0000.png and so on; frames that are there are not drawn again")
    ->type_name("DIR")
    ->required();
  command->add_option("--frames", options->frames, "number of pictures; default 96")
    ->type_name("N")
    ->check(CLI::Range(1, 1000000));
  command->add_option("--fps", options->rate, "pictures a second of the film; default 24")
    ->type_name("F")
    ->check(numberFrom(0.1, 240));
  command
    ->add_option("--from", options->from,
      "time of the first frame: as --time of render, or any date or second between the file's "
      "steps; default the file's first")
    ->type_name("T");
  command->add_option("--to", options->to, "that of the last frame; default the file's last")
    ->type_name("T");
  command->add_option("--size", options->size, "width and height, pixels; default the scene's")
    ->type_name("WxH");
  command->add_flag("--movie", options->movie,
    "make DIR/movie.mp4 with ffmpeg, or say how if that is not installed");
  addThreadsOption(*command);
  command->footer(
    "Several processes can be started with the same words: they share the work.\n"
    "Examples:\n"
    "  nephoscope animate Examples/Scenes/day.yaml -o day --movie\n"
    "  nephoscope animate Examples/Scenes/day.yaml -o try --frames 12 --size 320x240");
  command->callback([options] { runAnimate(*options); });
}
}
