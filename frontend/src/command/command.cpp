#include "frontend/command.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "base/elapsed.hpp"
#include "command/check.hpp"
#include "command/export_option.hpp"
#include "command/handover.hpp"
#include "command/message_writer.hpp"
#include "command/models.hpp"
#include "command/outputs.hpp"
#include "command/texts.hpp"
#include "command/versions.hpp"
#include "csgcore/workers.hpp"
#include "frontend/animated_picture.hpp"
#include "frontend/design_file.hpp"
#include "frontend/design_version.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/options.hpp"
#include "frontend/overlays.hpp"
#include "frontend/picture_file.hpp"
#include "frontend/run_program.hpp"
#include "frontend/statistics.hpp"
#include "frontend/terminal.hpp"
#include "picture/flat_figure.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {
namespace {

using csgcore::Image;

Image background_picture(const csgcore::View& view, const ColorScheme& scheme, bool with_channels) {
  Image image;
  image.width_px = view.width_px;
  image.height_px = view.height_px;
  const std::size_t pixels = std::size_t{view.width_px} * view.height_px;
  csgcore::FrameSettings frame;
  set_background(scheme, frame);
  fill_background(frame, image);
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

/// One run of the command that draws.
class Run {
 public:
  /// `text` is what text_in_memory() has given of the design, if it was asked.
  Run(const Options& options, const std::optional<FileText>& text, const Renderer& renderer,
      MessageWriter& messages)
      : options_(options),
        text_(text),
        renderer_(renderer),
        messages_(messages),
        progress_(!options.quiet && !messages.is_json() && isatty(STDERR_FILENO) == 1) {
    messages_.set_progress(&progress_);
  }
  ~Run() { messages_.set_progress(nullptr); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void execute() {
    if (wants_workers()) workers_.emplace();
    check_outputs();
    for (const std::string& warning : options_.warnings) say("warning", warning);
    begin_animations();
    std::vector<PendingOutput> outputs;
    for (frame_ = options_.first_frame; frame_ < options_.end_frame; ++frame_) {
      start_ = Clock::now();
      draw_frame(outputs);
    }
    finish_animations(outputs);
    if (!options_.stats_path.empty()) {
      outputs.push_back({options_.stats_path, bytes_of(to_json(stats_))});
    }
    if (!options_.rule_path.empty()) {
      outputs.push_back({options_.rule_path, bytes_of(rule_of(options_, files_))});
    }
    progress_.clear();
    check_outputs_differ(named_outputs(options_), named_inputs());  // all inputs are known now
    write_outputs(outputs);
  }

 private:
  /// Returns whether to start worker threads: small pictures are drawn by one thread.
  bool wants_workers() const {
    constexpr uint64_t kSmallPixels = 64 * 64;
    const CameraOptions& camera = options_.camera;
    const bool is_small = uint64_t{camera.width_px} * camera.height_px <= kSmallPixels;
    return !is_small && options_.render.threads != 1;
  }

  void draw_frame(std::vector<PendingOutput>& outputs) {
    if (frame_ == options_.first_frame || is_exported_) {
      design_ = import();
    }
    const CameraOptions camera_options = with_camera_of(design_camera_, options_.camera);
    Camera camera = choose_camera(camera_options, design_.view_box);
    if (options_.turns) camera.rotation_deg.z += 360.0 * frame_ / options_.frames;
    const csgcore::View view = make_view(camera, camera_options);
    if (!design_.flat_outlines.empty()) {
      color_flat_figure(design_.scene, view, options_.render.scheme);
    }
    Image image = draw(design_.scene, view, sees_nothing(camera, view.projection));
    encode(image, view, camera, outputs);
  }

  /// Returns the inputs that are known by now.
  std::vector<NamedPath> named_inputs() const {
    std::vector<NamedPath> inputs = design_inputs(options_.input, options_.openscad_arguments);
    for (const std::string& file : files_) inputs.push_back({"a file of the design", file});
    for (const std::string& file : imported_) inputs.push_back({"a file of the design", file});
    return inputs;
  }

  void check_outputs() const {
    check_all_outputs(options_);
    if (!options_.rule_path.empty()) rule_of(options_, {options_.input});
  }

  void show_progress(const std::string& stage, double fraction) {
    std::string text;
    if (options_.frames > 0) {
      text =
          "frame " + std::to_string(frame_ + 1) + " of " + std::to_string(options_.frames) + ", ";
    }
    progress_.update((text + stage).c_str(), fraction);
  }

  /// Says something on stderr, unless -q is given.
  void say(const std::string& group, const std::string& text) {
    if (!options_.quiet) messages_.say(group, text);
  }

  DesignFile read() {
    DesignFileOptions reading{options_};
    reading.import.measures_leaves = sees_all(options_.camera);
    reading.camera = camera_choice(options_);
    reading.view = view_of(options_);
    reading.text = text_;
    reading.inputs.time = frame_time(options_, frame_);
    reading.wants_files = !options_.rule_path.empty();
    reading.message = message_sink(options_, messages_);
    reading.progress = [this](const char* stage) { show_progress(stage, -1); };
    return read_design(options_.input, reading);
  }

  ImportedDesign import() {
    DesignFile file = read();
    stats_.file = file.name;
    stats_.file_bytes = file.file_bytes;
    stats_.read_ms = file.read_ms;
    stats_.export_ms = file.export_ms;
    stats_.parse_ms = file.parse_ms;
    stats_.nodes = file.tree.nodes->size();
    is_exported_ = file.is_exported;
    design_camera_ = file.camera;
    show_progress("importing", -1);
    const Clock::time_point import_start = Clock::now();
    ImportedDesign design = import_design(file);
    stats_.import_ms = ms_since(import_start);
    add_imported_files(design, file.files);
    imported_.insert(imported_.end(), design.files.begin(), design.files.end());
    for (const std::string& name : file.files) {
      if (std::find(files_.begin(), files_.end(), name) == files_.end()) files_.push_back(name);
    }
    stats_.primitive_nodes = design.primitive_nodes;
    stats_.leaves = design.leaves;
    stats_.compound_leaves = design.compound_leaves;
    stats_.faceted_leaves = design.faceted_leaves;
    stats_.left_out = design.left_out;
    stats_.layers = design.scene.layers.size();
    for (const Warning& warning : design.warnings) {
      if (options_.has_hard_warnings && !warning.is_note) throw Error(warning);
      if (!options_.quiet) messages_.say(warning);
    }
    return design;
  }

  bool writes_exr() const {
    return std::any_of(options_.outputs.begin(), options_.outputs.end(),
                       [](const Output& o) { return o.format == PictureFormat::kExr; });
  }

  Image render(const csgcore::Scene& scene, const csgcore::View& view,
               const RenderSettings& settings, RenderStats& stats) {
    if (!workers_) return renderer_(scene, view, settings, stats);
    Image image;
    workers_->run([&] { image = renderer_(scene, view, settings, stats); });
    return image;
  }

  Image draw(const csgcore::Scene& scene, const csgcore::View& view, bool sees_nothing) {
    RenderSettings settings = options_.render;
    const bool shows_channel = settings.show != Show::kSurface && settings.show != Show::kCells;
    if (options_.overlays.grid) settings.shares_from = csgcore::kNoPrimitive;
    settings.measured_channels = shows_channel || options_.overlays.any() || writes_exr();
    settings.all_stats = !options_.stats_path.empty();
    settings.progress = [this](const char* stage, double fraction) {
      show_progress(stage, fraction);
    };
    const Clock::time_point start = Clock::now();
    Image image;
    if ((scene.model.empty() && scene.layers.empty()) || sees_nothing) {
      // A picture without surfaces needs no renderer.
      image = background_picture(view, settings.scheme, settings.measured_channels);
      stats_.render.renderer = "none";
      stats_.render.render_ms = ms_since(start);
    } else {
      image = render(scene, view, settings, stats_.render);
      if (settings.technique == Technique::kTiles && stats_.render.technique == "cells") {
        say("warning",
            "more primitives lie behind each other than OpenGL can take by tiles: it has drawn "
            "cells");
      }
    }
    if (options_.info) say("", renderer_line(stats_.render));
    return image;
  }

  void encode(Image& image, const csgcore::View& view, const Camera& camera,
              std::vector<PendingOutput>& outputs) {
    show_progress("encoding", -1);
    const Clock::time_point start = Clock::now();
    const ColorScheme& scheme = options_.render.scheme;
    show_channel(image, options_.render.show, scheme.background);
    if (options_.render.show == Show::kSurface && !sees_nothing(camera, view.projection)) {
      draw_flat_outlines(image, view, camera, design_, scheme);
    }
    const csgcore::ThreadLimit limit(options_.render.threads);
    draw_overlays(image, view, camera, options_.overlays, scheme, design_);
    for (size_t i = 0; i < options_.outputs.size(); ++i) {
      const Output& output = options_.outputs[i];
      if (is_animated(output.format)) {
        animations_[i]->add(image);
      } else {
        outputs.push_back(
            {path_of(output, options_, frame_), encode_picture(image, output.format)});
      }
    }
    stats_.width_px = image.width_px;
    stats_.height_px = image.height_px;
    stats_.encode_ms = ms_since(start);
    stats_.total_ms = ms_since(start_) - stats_.render.measuring_ms;
  }

  void begin_animations() {
    for (const Output& output : options_.outputs) {
      animations_.push_back(is_animated(output.format)
                                ? AnimationEncoder::make(output.format, options_.fps)
                                : nullptr);
    }
  }

  void finish_animations(std::vector<PendingOutput>& outputs) {
    for (size_t i = 0; i < animations_.size(); ++i) {
      if (animations_[i]) outputs.push_back({options_.outputs[i].path, animations_[i]->finish()});
    }
  }

  const Options& options_;
  const std::optional<FileText>& text_;
  const Renderer& renderer_;
  MessageWriter& messages_;
  Clock::time_point start_ = Clock::now();  // start of the frame
  uint32_t frame_ = 0;
  ImportedDesign design_;
  DesignCamera design_camera_;
  bool is_exported_ = false;           // set anew for every frame
  std::vector<std::string> files_;     // files that the design was read from, for all frames
  std::vector<std::string> imported_;  // those that its nodes name, whether or not all are wanted
  std::vector<std::unique_ptr<AnimationEncoder>> animations_;  // by output; null: it is none
  RunStats stats_;                                             // of the frame
  ProgressLine progress_;
  std::optional<csgcore::Workers> workers_;
};

/// Runs scadray-gl in place of this program. Returns if that is not there and the CPU may draw.
void run_gl_program(const std::vector<std::string>& arguments, RendererKind kind) {
  try {
    run_subcommand(
        "gl", arguments,
        "give --renderer=cpu; or build scadray with SCADRAY_GLRENDER=ON where libepoxy is "
        "installed (libepoxy-dev)");
  } catch (const Error&) {
    if (kind == RendererKind::kGl) throw;
  }
}

/// The advice for a run that is out of memory.
constexpr const char* kSmaller = "a smaller --imgsize or design";

/// Writes all outputs of a design. What is read more than once is read into memory first: it may be
/// a pipe.
ExitCode draw(const Options& options, const Renderer& renderer, MessageWriter& messages) {
  std::optional<FileText> text;
  if (options.first_frame == options.end_frame) return ExitCode::kDone;
  const bool has_summary = options.summary.any() || !options.summary_path.empty();
  const bool is_model_made = !options.models.empty() || (has_summary && !options.outputs.empty());
  if (!options.handed.empty() || !options.texts.empty() || is_model_made || options.frames > 0) {
    text = text_in_memory(options.input);
  }
  if (const ExitCode code = write_handed(options, text); code != ExitCode::kDone) return code;
  if (const ExitCode code = write_texts(options, text, messages); code != ExitCode::kDone) {
    return code;
  }
  if (is_model_made) write_models(options, text, messages);
  if (!options.outputs.empty()) Run(options, text, renderer, messages).execute();
  return ExitCode::kDone;
}

ExitCode run(const std::vector<std::string>& arguments, const Renderer& renderer,
             const GlProgramChoice& drawn_by_gl_program, MessageWriter& messages) {
  if (!arguments.empty() && arguments[0] == "check") {
    return check_designs({arguments.begin() + 1, arguments.end()});
  }
  if (!arguments.empty() && (arguments[0] == "bench" || arguments[0] == "serve")) {
    run_subcommand(arguments[0], {arguments.begin() + 1, arguments.end()},
                   "install scadray as a whole: its programs belong into one folder");
  }
  if (!arguments.empty() && arguments[0] == "validate") {
    run_subcommand(arguments[0], {arguments.begin() + 1, arguments.end()},
                   "install the package scadray-validate, or build scadray with SCADRAY_ORACLE=ON "
                   "where CGAL is installed (libcgal-dev)");
  }
  const Options options = parse_options(arguments);
  switch (options.action) {
    case Action::kHelp:
      std::fputs(help_text().c_str(), stdout);
      break;
    case Action::kHelpExport:
      std::fputs(export_settings_text().c_str(), stdout);
      break;
    case Action::kVersion:
      print_version();
      break;
    case Action::kInfo:
      print_info();
      break;
    case Action::kOpenWindow:
      run_subcommand("window", arguments,
                     "give -o FILE.png to draw without a window; or build scadray with "
                     "SCADRAY_WINDOW=ON where GLFW and Dear ImGui are installed (libglfw3-dev, "
                     "libimgui-dev)");
    case Action::kDraw:
      if (!options.outputs.empty() && drawn_by_gl_program && drawn_by_gl_program(options.render)) {
        run_gl_program(arguments, options.render.renderer);
      }
      return draw(options, renderer, messages);
  }
  return ExitCode::kDone;
}

}  // namespace

ExitCode run_command(const std::vector<std::string>& arguments, const Renderer& renderer,
                     const GlProgramChoice& drawn_by_gl_program) {
  const auto program = [&] {
    MessageWriter messages(message_format(arguments));
    try {
      return run(arguments, renderer, drawn_by_gl_program, messages);
    } catch (const Error& error) {
      messages.say(error);
    } catch (const std::bad_alloc&) {
      if (!messages.is_json()) throw;
      messages.say(Error({}, {}, "out of memory", std::string("try ") + kSmaller));
    } catch (const std::exception& error) {
      messages.say(Error({}, {}, error.what(), {}));
    }
    return ExitCode::kFailure;
  };
  return run_program(program, kSmaller);
}

}  // namespace frontend
