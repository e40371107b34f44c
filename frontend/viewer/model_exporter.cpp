#include "model_exporter.hpp"

#include <exception>
#include <new>
#include <utility>

#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/model_export.hpp"
#include "frontend/stop.hpp"

namespace window {
namespace {

/// Adds the warnings, the first of which is an error with --hardwarnings.
void add_warnings(const ModelOrder& order, const std::vector<frontend::Warning>& warnings,
                  ModelOutcome& outcome) {
  for (const frontend::Warning& warning : warnings) {
    if (order.options.has_hard_warnings && !warning.is_note) throw frontend::Error(warning);
    outcome.warnings.push_back(warning.text);
  }
}

}  // namespace

ModelExporter::ModelExporter(std::function<void()> on_news) : on_news_(std::move(on_news)) {}

void ModelExporter::start(ModelOrder order) {
  activity_.begin("exporting");
  // An export that was stopped may not have come to its end. The new one waits for it.
  thread_ = std::jthread([this, before = std::move(thread_),
                          order = std::move(order)](const std::stop_token& stop) mutable {
    if (before.joinable()) before.join();
    run(order, stop);
  });
}

std::optional<ModelOutcome> ModelExporter::take_outcome() {
  const std::lock_guard lock(mutex_);
  return std::exchange(outcome_, std::nullopt);
}

bool ModelExporter::stop() {
  const std::lock_guard lock(mutex_);
  if (is_writing_ || !activity_.current()) return false;
  thread_.request_stop();
  activity_.end();
  return true;
}

/// Returns false if the export was stopped. From now on it cannot be.
bool ModelExporter::begin_writing(const std::stop_token& stop) {
  const std::lock_guard lock(mutex_);
  is_writing_ = !stop.stop_requested();
  return is_writing_;
}

void ModelExporter::run(const ModelOrder& order, const std::stop_token& stop) {
  ModelOutcome outcome{order.path, {}, {}};
  try {
    const csgcore::StopScope scope(&stop);
    make(order, stop, outcome);
  } catch (const csgcore::Stopped&) {
    return;
  } catch (const std::bad_alloc&) {
    outcome.error = order.path + ": error: out of memory (try a smaller design)";
  } catch (const std::exception& error) {
    outcome.error = error.what();
  }
  {
    const std::lock_guard lock(mutex_);
    if (stop.stop_requested()) return;  // it has failed after that
    is_writing_ = false;
    outcome_ = std::move(outcome);
    activity_.end();
  }
  on_news_();
}

void ModelExporter::make(const ModelOrder& order, const std::stop_token& stop,
                         ModelOutcome& outcome) {
  const frontend::Options& options = order.options;
  const auto show = [&](const std::string& stage) {
    if (!stop.stop_requested()) activity_.update("exporting: " + stage, -1);
  };
  const frontend::ModelFormat format = frontend::model_format(order.path);
  frontend::check_output(order.path);
  const frontend::NamedPath output{"an export", order.path};
  std::vector<frontend::NamedPath> inputs =
      frontend::design_inputs(options.input, options.openscad_arguments);
  frontend::check_outputs_differ({&output, 1}, inputs);

  frontend::DesignFileOptions reading{options};
  reading.import = frontend::options_for_export(options.import);
  reading.import.tolerance = options.model_tolerance;
  reading.import.language = order.inputs.language.value_or(options.import.language);
  reading.inputs = order.inputs;
  reading.camera = language::CameraChoice::kWindow;
  reading.text = order.stream;
  reading.overlay = order.overlay;
  reading.wants_files = true;
  reading.message = [](const frontend::DesignMessage&) {};  // the window has them
  reading.progress = [&show](const char* stage) { show(stage); };
  frontend::DesignText text = frontend::read_design_text(options.input, reading, stop);
  show("importing");
  const frontend::DesignTree tree = frontend::tree_of(text, stop);
  const frontend::ImportedDesign design =
      frontend::import_design(tree, frontend::beside(options.input, text, reading.import), stop);
  add_warnings(order, design.warnings, outcome);
  frontend::add_imported_files(design, text.files);
  for (const std::string& file : text.files) inputs.push_back({"a file of the design", file});
  frontend::check_outputs_differ({&output, 1}, inputs);

  show("making the surface");
  frontend::ModelExport model(design, tree, options.render.threads, options.export_settings);
  const frontend::PendingOutput file{order.path, frontend::bytes_of(model.encode(format))};
  add_warnings(order, model.warnings(), outcome);
  if (begin_writing(stop)) frontend::write_outputs({&file, 1});
}

}  // namespace window
