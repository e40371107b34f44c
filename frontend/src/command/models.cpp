#include "command/models.hpp"

#include <unistd.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/elapsed.hpp"
#include "base/geometry_dialect.hpp"
#include "command/outputs.hpp"
#include "command/summary.hpp"
#include "frontend/design_file.hpp"
#include "frontend/design_version.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/model_export.hpp"
#include "frontend/terminal.hpp"

namespace frontend {
namespace {

class ModelRun {
 public:
  ModelRun(const Options& options, const std::optional<FileText>& text, MessageWriter& messages)
      : options_(options),
        text_(text),
        messages_(messages),
        progress_(!options.quiet && !messages.is_json() && isatty(STDERR_FILENO) == 1) {
    messages_.set_progress(&progress_);
  }
  ~ModelRun() { messages_.set_progress(nullptr); }
  ModelRun(const ModelRun&) = delete;
  ModelRun& operator=(const ModelRun&) = delete;

  void execute() {
    check_all_outputs(options_);
    if (options_.outputs.empty()) {  // a picture's run says them, too
      for (const std::string& warning : options_.warnings) {
        if (!is_silent()) messages_.say("warning", warning);
      }
    }
    for (uint32_t frame = options_.first_frame; frame < options_.end_frame; ++frame) {
      export_frame(frame);
    }
    if (!options_.summary_path.empty()) {
      outputs_.push_back(
          {options_.summary_path, bytes_of(summary_json(options_.summary, summary_))});
    }
    if (!options_.rule_path.empty() && options_.outputs.empty()) {
      outputs_.push_back({options_.rule_path, bytes_of(rule_of(options_, files_))});
    }
    progress_.clear();
    std::vector<NamedPath> inputs = design_inputs(options_.input, options_.openscad_arguments);
    for (const std::string& file : files_) inputs.push_back({"a file of the design", file});
    check_outputs_differ(named_outputs(options_), inputs);
    write_outputs(outputs_);
  }

 private:
  /// Whether a summary is all that is asked for: then the run of the pictures has the messages.
  bool is_silent() const { return options_.quiet || options_.models.empty(); }

  void warn(const std::vector<Warning>& warnings) {
    for (const Warning& warning : warnings) {
      if (options_.has_hard_warnings && !warning.is_note) throw Error(warning);
      if (!is_silent()) messages_.say(warning);
    }
  }

  DesignFile read(uint32_t frame) {
    DesignFileOptions reading{options_};
    reading.import = options_for_export(options_.import);
    reading.import.tolerance = options_.model_tolerance;
    reading.view = view_of(options_);
    reading.text = text_;
    reading.inputs.time = frame_time(options_, frame);
    reading.wants_files = !options_.rule_path.empty();
    reading.message = [this, sink = message_sink(options_, messages_)](const DesignMessage& line) {
      if (!options_.models.empty()) sink(line);
    };
    reading.progress = [this](const char* stage) { progress_.update(stage, -1); };
    return read_design(options_.input, reading);
  }

  void deprecate_formats() {
    const auto is_amf = [](const ModelOutput& output) {
      return output.format == ModelFormat::kAmf;
    };
    if (!GeometryDialect(options_.import.language).deprecates_amf || is_silent()) return;
    if (std::ranges::any_of(options_.models, is_amf))
      messages_.say(DesignMessage{"DEPRECATED: AMF export is deprecated. Please use 3MF instead."});
  }

  /// Notes the figures of the frame's design, and shows them unless they go to a file.
  void summarize(ModelExport& model, const DesignCamera& camera, Clock::time_point start) {
    summary_.camera = with_camera_of(camera, options_.camera).camera.value_or(Camera{});
    summary_.time_ms = ms_since(start);
    const SummaryParts& parts = options_.summary;
    if (parts.geometry || parts.bounding_box || parts.area) summary_.figures = model.figures();
    if (!options_.summary_path.empty() || options_.quiet) return;
    progress_.clear();
    print_text(stderr, summary_text(parts, summary_));
  }

  void export_frame(uint32_t frame) {
    const Clock::time_point start = Clock::now();
    DesignFile file = read(frame);
    progress_.update("importing", -1);
    const ImportedDesign design = import_design(file);
    warn(design.warnings);
    add_imported_files(design, file.files);
    for (const std::vector<std::string>& names : {file.files, design.files}) {
      for (const std::string& name : names) {
        if (std::find(files_.begin(), files_.end(), name) == files_.end()) files_.push_back(name);
      }
    }
    ModelExport model(design, file.tree, options_.render.threads, options_.export_settings);
    for (const ModelOutput& output : options_.models) model.check(output.format);
    if (frame == options_.first_frame) deprecate_formats();
    std::size_t told = 0;
    for (const ModelOutput& output : options_.models) {
      progress_.update("making the surface", -1);
      outputs_.push_back({path_of(output, options_, frame), bytes_of(model.encode(output.format))});
      if (told == 0) warn(model.warnings());
      told = model.warnings().size();
    }
    summarize(model, file.camera, start);
  }

  const Options& options_;
  const std::optional<FileText>& text_;
  MessageWriter& messages_;
  ProgressLine progress_;
  std::vector<std::string> files_;  // that the design was read from, for all frames
  std::vector<PendingOutput> outputs_;
  Summary summary_;  // of the last frame
};

}  // namespace

void write_models(const Options& options, const std::optional<FileText>& text,
                  MessageWriter& messages) {
  ModelRun(options, text, messages).execute();
}

}  // namespace frontend
