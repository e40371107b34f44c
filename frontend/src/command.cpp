#include "frontend/command.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <new>

#include "elapsed.hpp"
#include "frontend/axes_overlay.hpp"
#include "frontend/channel_picture.hpp"
#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/options.hpp"
#include "frontend/picture_file.hpp"
#include "frontend/progress.hpp"
#include "frontend/statistics.hpp"
#include "frontend/subcommand.hpp"
#include "make_rule.hpp"

namespace frontend {
namespace {

using csgcore::Image;

Image background_picture(const csgcore::View& view, Rgb color, bool with_channels) {
  Image image;
  image.width_px = view.width_px;
  image.height_px = view.height_px;
  const std::size_t pixels = std::size_t{view.width_px} * view.height_px;
  image.rgb.assign(pixels, {color.r, color.g, color.b});
  if (with_channels) {
    image.z.assign(pixels, std::numeric_limits<float>::infinity());
    image.normal.assign(pixels, glm::vec3(0.0f));
    image.position.assign(pixels, glm::vec3(0.0f));
    image.id.assign(pixels, csgcore::kNoPrimitive);
  }
  return image;
}

std::string renderer_line(const RenderStats& stats) {
  return "renderer: " + stats.renderer + (stats.reason.empty() ? "" : " (" + stats.reason + ")");
}

Bytes bytes_of(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

/// One run that draws.
class Run {
 public:
  Run(const Options& options, const Renderer& renderer)
      : options_(options),
        renderer_(renderer),
        progress_(!options.quiet && isatty(STDERR_FILENO) == 1) {}

  void execute() {
    check_outputs();
    for (const std::string& warning : options_.warnings) say("warning: " + warning);
    const ImportedDesign design = import();
    const Camera camera = choose_camera(options_.camera, design.view_box);
    const csgcore::View view = make_view(camera, options_.camera);
    Image image = draw(design.scene, view);
    const std::vector<PendingOutput> outputs = encode(image, view, camera);
    progress_.clear();
    write_outputs(outputs);
  }

 private:
  void check_outputs() const {
    for (const Output& output : options_.outputs) check_output(output.path);
    for (const std::string& path : {options_.stats_path, options_.rule_path}) {
      if (!path.empty()) check_output(path);
    }
  }

  /// A line on stderr, unless -q.
  void say(const std::string& text) {
    if (options_.quiet) return;
    progress_.clear();
    std::fprintf(stderr, "%s\n", text.c_str());
  }

  DesignFile read() {
    DesignFileOptions reading;
    reading.openscad_arguments = options_.openscad_arguments;
    reading.wants_files = !options_.rule_path.empty();
    reading.message = [this](const std::string& line) {
      if (!options_.quiet || line.starts_with("ERROR")) {
        progress_.clear();
        std::fprintf(stderr, "%s\n", line.c_str());
      }
    };
    reading.progress = [this](const char* stage) { progress_.update(stage, -1); };
    return read_design(options_.input, reading);
  }

  ImportedDesign import() {
    const DesignFile file = read();
    stats_.file = file.name;
    stats_.file_bytes = file.file_bytes;
    stats_.read_ms = file.read_ms;
    stats_.export_ms = file.export_ms;
    stats_.parse_ms = file.parse_ms;
    stats_.nodes = file.tree.nodes.size();
    files_ = file.files;
    progress_.update("importing", -1);
    const Clock::time_point import_start = Clock::now();
    ImportedDesign design = import_design(file.tree, options_.import);
    stats_.import_ms = ms_since(import_start);
    stats_.primitive_nodes = design.primitive_nodes;
    for (const Warning& warning : design.warnings) say(warning.text);
    return design;
  }

  bool writes_exr() const {
    return std::any_of(options_.outputs.begin(), options_.outputs.end(),
                       [](const Output& o) { return o.format == PictureFormat::kExr; });
  }

  Image draw(const csgcore::Scene& scene, const csgcore::View& view) {
    RenderSettings settings = options_.render;
    const bool shows_channel = settings.show != Show::kSurface && settings.show != Show::kCells;
    settings.measured_channels = shows_channel || options_.axes || writes_exr();
    settings.all_stats = !options_.stats_path.empty();
    settings.progress = [this](const char* stage, double fraction) {
      progress_.update(stage, fraction);
    };
    const Clock::time_point start = Clock::now();
    Image image;
    if (scene.model.empty() && scene.background.empty() && scene.highlight.empty()) {
      // Nothing to draw needs no renderer.
      image = background_picture(view, settings.scheme.background, settings.measured_channels);
      stats_.render.renderer = "none";
      stats_.render.render_ms = ms_since(start);
    } else {
      image = renderer_(scene, view, settings, stats_.render);
      if (settings.technique == Technique::kTiles && stats_.render.technique == "cells") {
        say("warning: --technique=tiles has no effect with OpenGL in this version");
      }
    }
    if (options_.info) say(renderer_line(stats_.render));
    return image;
  }

  std::vector<PendingOutput> encode(Image& image, const csgcore::View& view, const Camera& camera) {
    progress_.update("encoding", -1);
    const Clock::time_point start = Clock::now();
    const ColorScheme& scheme = options_.render.scheme;
    show_channel(image, options_.render.show, scheme.background);
    if (options_.axes) draw_axes(image, view, camera, scheme.axes);
    std::vector<PendingOutput> outputs;
    for (const Output& output : options_.outputs) {
      outputs.push_back({output.path, encode_picture(image, output.format)});
    }
    stats_.width_px = image.width_px;
    stats_.height_px = image.height_px;
    stats_.encode_ms = ms_since(start);
    stats_.total_ms = ms_since(start_) - stats_.render.measuring_ms;
    if (!options_.stats_path.empty()) {
      outputs.push_back({options_.stats_path, bytes_of(to_json(stats_))});
    }
    if (!options_.rule_path.empty()) outputs.push_back({options_.rule_path, bytes_of(rule())});
    return outputs;
  }

  std::string rule() const {
    std::vector<std::string> targets;
    for (const Output& output : options_.outputs) {
      targets.push_back(output.path == "-" ? "<stdout>" : output.path);
    }
    return make_rule(targets, files_);
  }

  const Options& options_;
  const Renderer& renderer_;
  Clock::time_point start_ = Clock::now();
  RunStats stats_;
  std::vector<std::string> files_;  // that the design was read from
  ProgressLine progress_;
};

void print_info() {
  std::printf("scadray %s\npictures: PNG (libspng), EXR (OpenEXR)\nrenderers: %s\n.scad by: %s\n",
              SCADRAY_VERSION, SCADRAY_RENDERERS, "openscad on PATH, or $OPENSCAD");
}

void run(const std::vector<std::string>& arguments, const Renderer& renderer) {
  if (!arguments.empty() && arguments[0] == "validate") {
    run_subcommand(arguments[0], {arguments.begin() + 1, arguments.end()});
  }
  const Options options = parse_options(arguments);
  switch (options.action) {
    case Action::kHelp:
      std::fputs(help_text().c_str(), stdout);
      break;
    case Action::kVersion:
      std::printf("scadray version %s\n", SCADRAY_VERSION);
      break;
    case Action::kInfo:
      print_info();
      break;
    case Action::kDraw:
      Run(options, renderer).execute();
      break;
  }
}

}  // namespace

ExitCode run_command(const std::vector<std::string>& arguments, const Renderer& renderer) {
  try {
    run(arguments, renderer);
    if (std::fflush(stdout) != 0) throw Error("", {}, "standard output cannot be written", "");
    return ExitCode::kDone;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
  } catch (const std::bad_alloc&) {
    std::fputs("error: out of memory (try a smaller --imgsize or design)\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
  return ExitCode::kFailure;
}

}  // namespace frontend
