// The command line, as OpenSCAD's own parser reads it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frontend/camera.hpp"
#include "frontend/import_options.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/overlays.hpp"
#include "frontend/picture_file.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {

struct Output {
  std::string path;  // "-": standard output
  PictureFormat format;
};

/// What the command is to do.
enum class Action : uint8_t { kDraw, kOpenWindow, kHelp, kVersion, kInfo };

/// The whole command line, checked: every value is in its documented range.
struct Options {
  Action action = Action::kDraw;
  std::string input;            // "-": a .csg from standard input
  std::vector<Output> outputs;  // kDraw: at least one, at most one of them "-"
  std::string stats_path;       // empty: none; "-": standard output
  std::string rule_path;        // for make: what the outputs are made of; empty: none
  CameraOptions camera;
  bool has_image_size = false;  // the command line says it
  Overlays overlays;
  ImportOptions import;
  RenderSettings render;
  std::vector<std::string> openscad_arguments;  // handed on to openscad for a .scad
  std::vector<std::string> warnings;            // what is ignored, without the word "warning"
  uint32_t frames = 0;  // of an animation, each in files of its own; 0: a single picture
  bool quiet = false;
  bool has_hard_warnings = false;  // a warning of the design ends the run
  bool info = false;
};

/// A run that writes more pictures than this is refused: each is registered for removal at an
/// interruption, as are statistics and the rule for make.
constexpr std::size_t kMaxPictures = kMaxRemovedFiles - 2;

/// By the path's suffix. Throws Error for any other.
PictureFormat picture_format(const std::string& path);

/// Throws Error for anything that is wrong with the arguments (without the program's name).
Options parse_options(const std::vector<std::string>& arguments);

/// The text of --help.
std::string help_text();

}  // namespace frontend
