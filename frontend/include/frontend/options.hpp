// The command line, as OpenSCAD's own parser reads it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "frontend/animated_picture.hpp"
#include "frontend/camera.hpp"
#include "frontend/design_file_options.hpp"
#include "frontend/export_settings.hpp"
#include "frontend/import_options.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/model_format.hpp"
#include "frontend/overlays.hpp"
#include "frontend/picture_file.hpp"
#include "frontend/render_settings.hpp"
#include "frontend/text_kind.hpp"
#include "language/evaluation.hpp"

namespace frontend {

struct Output {
  std::string path;  // "-": standard output
  PictureFormat format;
};

struct TextOutput {
  std::string path;  // "-": standard output
  TextKind kind;
};

struct ModelOutput {
  std::string path;  // "-": standard output
  ModelFormat format;
};

/// An output in a format that scadray leaves to the installed openscad.
struct HandedOutput {
  std::string path;    // "-": standard output
  std::string format;  // a word of --export-format
};

/// The action that a command line asks for.
enum class Action : uint8_t { kDraw, kOpenWindow, kHelp, kHelpExport, kVersion, kInfo };

/// The options that are given of those whose values a window remembers from run to run.
struct GivenLook {
  bool scheme = false;
  bool view = false;
  bool projection = false;
  bool shading = false;
  bool samples = false;
  bool translucency = false;
};

/// The whole command line, checked: every value is in its documented range.
struct Options : ReadingOptions {
  Action action = Action::kDraw;
  std::string input;                        // "-": standard input
  std::vector<std::string> further_inputs;  // kOpenWindow: each of them gets a window of its own
  /// kDraw: these, `handed`, `texts` and `models` are at least one; one of all may be "-".
  std::vector<Output> outputs;
  std::vector<HandedOutput> handed;  // written first
  std::vector<TextOutput> texts;     // written next
  std::vector<ModelOutput> models;   // written before the pictures
  double model_tolerance = 0;        // ImportOptions::tolerance of the models
  ExportSettings export_settings;    // of the models
  SummaryParts summary;
  std::string summary_path;  // of the summary, as JSON; "-": standard output; empty: as text, on
                             // standard error
  std::string stats_path;    // empty: none; "-": standard output
  std::string editor;        // --editor; empty: the environment tells it
  bool pans_far = false;     // --pan: in the window, as far as OpenSCAD
  std::string rule_path;     // the rule for make that lists the outputs' sources; empty: none
  CameraOptions camera;
  bool has_image_size = false;  // --imgsize is given
  bool resets_window = false;   // the window forgets what it remembers, but the designs
  GivenLook given;
  Overlays overlays;
  RenderSettings render;
  std::vector<std::string> handed_arguments;  // OpenSCAD's, for `handed`
  std::vector<std::string> warnings;          // ignored options, without the word "warning"
  uint32_t frames = 0;  // frames of an animation, each in files of its own; 0: a single picture
  /// The frames that are drawn: first_frame <= i < end_frame.
  uint32_t first_frame = 0;
  uint32_t end_frame = 1;
  double fps = kDefaultFps;  // frames a second of animated pictures
  bool turns = false;        // the camera goes once around the design during them
  bool quiet = false;
  bool prints_echoes = false;      // what the design echoes goes to standard output
  bool has_hard_warnings = false;  // a warning of the design ends the run
  bool info = false;
};

/// Returns the camera that a design of 2026 finds in its $vpt, $vpr and $vpd.
inline language::ViewCamera view_of(const Options& options) {
  const Camera camera = options.camera.camera.value_or(Camera{});
  const auto numbers = [](const csgcore::Vec3& v) { return std::array<double, 3>{v.x, v.y, v.z}; };
  return {numbers(camera.target), numbers(camera.rotation_deg), camera.distance};
}

/// Returns what a picture's camera is chosen by.
inline language::CameraChoice camera_choice(const Options& options) {
  return options.camera.camera ? language::CameraChoice::kCommand : language::CameraChoice::kDesign;
}

/// The most pictures, or models, of a run. Each is registered for removal at an interruption, as
/// are the statistics and the rule for make.
constexpr std::size_t kMaxPictures = kMaxRemovedFiles - 2;

/// Returns the format of the path's suffix. Throws Error for any other suffix.
PictureFormat picture_format(const std::string& path);

/// The same of a solid or plane figure.
ModelFormat model_format(const std::string& path);

/// Parses the arguments (without the program's name). Throws Error for any that is wrong.
Options parse_options(const std::vector<std::string>& arguments);

/// Returns the text of --help.
std::string help_text();

}  // namespace frontend
