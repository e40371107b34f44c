#include "follow/design_reading.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <system_error>
#include <utility>

#include "base/elapsed.hpp"
#include "follow/evaluated_design.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/stop.hpp"
#include "language/customizer.hpp"
#include "language/evaluation.hpp"

namespace frontend {
namespace {

/// The most bytes of openscad's messages that are kept: openscad may write the same for ever.
constexpr std::size_t kMostMessageBytes = std::size_t{1} << 20;

/// Returns a function that adds lines to the version's messages.
DesignMessageSink keeping_messages(DesignVersion& version) {
  return [&version, bytes = std::size_t{0}](const DesignMessage& message) mutable {
    if (bytes > kMostMessageBytes) return;
    bytes += message.text.size();
    const bool is_last = bytes > kMostMessageBytes;
    version.messages.push_back(is_last ? "(the evaluation says more)" : message.text);
    version.places.push_back(is_last ? SourcePlace{} : message.place);
    if (!message.follows_error) version.before_error = version.messages.size();
  };
}

void import_into(DesignReading& reading, DesignTree tree, const ImportOptions& options,
                 const DesignText& text, const std::stop_token& stop) {
  const Clock::time_point start = Clock::now();
  auto design = std::make_shared<const ImportedDesign>(import_design(tree, options, stop));
  reading.version.import_ms = ms_since(start);
  GoodVersion& good = reading.good;
  good.source = {std::move(tree), text.evaluation};
  good.design = std::move(design);
  good.is_exported = text.is_exported;
}

void read_into(DesignReading& reading, const std::string& path, const DesignFileOptions& options,
               const std::stop_token& stop) {
  DesignVersion& version = reading.version;
  DesignFileOptions file_options = options;
  file_options.wants_files = true;
  file_options.message = keeping_messages(version);
  // A picture without what a used file has is shown only where there is none with it.
  file_options.needs_all_files = reading.good.design && !reading.good.lacks_files;
  if (!file_options.progress) file_options.progress = [](const char*) {};
  if (is_read_once(path)) {
    if (!reading.good.stream) reading.good.stream = text_in_memory(path, stop);
    file_options.text = reading.good.stream;
  }
  file_options.watch = [&reading](std::vector<std::string> paths) {
    reading.watched = std::move(paths);
  };
  DesignText text = read_design_text(path, file_options, stop);
  const Clock::time_point start = Clock::now();
  DesignTree tree = tree_of(text, stop);
  version.parse_ms = ms_since(start);
  file_options.progress("importing");
  import_into(reading, std::move(tree), beside(path, text, file_options.import), text, stop);
  reading.good.lacks_files = text.evaluation && text.evaluation->has_unparsed_files;
  if (text.evaluation) version.camera = camera_of(*text.evaluation);
  version.export_ms = text.export_ms;
  version.read_ms = text.read_ms;
  version.files = std::move(text.files);
  version.design = reading.good.design;
  add_imported_files(*version.design, version.files);
  version.source = reading.good.source;
  for (const Warning& warning : version.design->warnings) {
    version.messages.push_back(warning.text);
  }
}

/// Finds what the main file of a .scad offers, also of one that cannot be evaluated.
void find_parameters(DesignReading& reading, const std::string& path,
                     language::LanguageVersion language) {
  std::shared_ptr<const DesignParameters>& known = reading.good.parameters;
  const std::optional<FileText>& stream = reading.good.stream;
  std::error_code failed;
  const DesignKind kind = kind_of(path);
  const bool is_scad =
      kind == DesignKind::kScad ||
      (kind == DesignKind::kEither && (!reading.version.error.empty() || reading.good.is_exported));
  if (is_scad && (stream || std::filesystem::is_regular_file(path, failed))) {
    const FileText text = stream ? *stream : read_file(path);
    if (!known || known->text != text.view()) {
      auto list = language::customizer_parameters(text.view(), language);
      if (list) {
        known = std::make_shared<const DesignParameters>(
            DesignParameters{std::string(text.view()), std::move(*list)});
      }
    }
  }
  reading.version.parameters = known;
}

/// Does the work, and reports in the version why it fails.
template <typename Work>
void report_failures(const std::string& path, DesignReading& reading, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    reading.version.error = error.what();
  } catch (const std::bad_alloc&) {
    reading.version.error = input_name(path) + ": error: out of memory (try a smaller design)";
  } catch (const std::exception& error) {
    reading.version.error = input_name(path) + ": error: " + error.what();
  }
}

}  // namespace

DesignReading read_anew(const std::string& path, const DesignFileOptions& options,
                        const GoodVersion& before, const std::stop_token& stop) {
  DesignReading reading;
  reading.good = before;
  reading.version.inputs = options.inputs;
  report_failures(path, reading, [&] { read_into(reading, path, options, stop); });
  report_failures(path, reading, [&] { find_parameters(reading, path, options.import.language); });
  reading.version.stream = reading.good.stream;
  return reading;
}

}  // namespace frontend
