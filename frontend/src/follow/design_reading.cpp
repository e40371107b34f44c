#include "follow/design_reading.hpp"

#include <exception>
#include <functional>
#include <new>
#include <optional>
#include <utility>

#include "base/elapsed.hpp"
#include "frontend/error.hpp"
#include "frontend/stop.hpp"

namespace frontend {
namespace {

/// The most bytes of openscad's messages that are kept: openscad may write the same for ever.
constexpr std::size_t kMostMessageBytes = std::size_t{1} << 20;

/// Returns a function that adds lines to the version's messages.
std::function<void(const std::string&)> keeping_messages(DesignVersion& version) {
  return [&version, bytes = std::size_t{0}](const std::string& line) mutable {
    if (bytes > kMostMessageBytes) return;
    bytes += line.size();
    version.messages.push_back(bytes > kMostMessageBytes ? "(openscad says more)" : line);
  };
}

/// Returns nothing if the text is that of the version before, and neither names files nor has text,
/// whose fonts may have changed.
std::optional<TextImport> parse_text(const DesignText& text, const ImportOptions& options,
                                     DesignReading& reading, const std::stop_token& stop) {
  const ImportedDesign* const before = reading.good.design.get();
  reading.version.unchanged = before != nullptr && before->files.empty() && !before->has_text &&
                              before->lines_to_render.empty() &&
                              reading.good.csg->view() == text.csg.view();
  if (reading.version.unchanged) return std::nullopt;
  const Clock::time_point start = Clock::now();
  TextImport import(text.csg.view(), text.name, options, stop);
  reading.version.parse_ms = ms_since(start);
  return import;
}

GoodVersion finish_import(TextImport& import, DesignText& text, DesignVersion& version,
                          const std::stop_token& stop) {
  const Clock::time_point start = Clock::now();
  auto design = std::make_shared<const ImportedDesign>(import.finish(stop));
  version.import_ms = ms_since(start) - design->rendering_ms;
  return {std::make_shared<const FileText>(std::move(text.csg)), std::move(design), import.nodes(),
          text.name, text.is_exported};
}

void read_into(DesignReading& reading, const std::string& path, const DesignFileOptions& options,
               const std::stop_token& stop) {
  DesignVersion& version = reading.version;
  DesignFileOptions file_options = options;
  file_options.wants_files = true;
  file_options.import.rendering.waits = false;
  file_options.message = keeping_messages(version);
  file_options.progress = [](const char*) {};
  DesignText text = read_design_text(path, file_options, stop);
  std::optional<TextImport> import;
  try {
    import = parse_text(text, beside(path, text, file_options.import), reading, stop);
  } catch (const Error&) {
    if (text.is_exported || !may_be_scad(path)) throw;
    reading.is_scad = true;
  }
  if (reading.is_scad) {
    export_design_text(path, file_options, text, stop);
    import = parse_text(text, beside(path, text, file_options.import), reading, stop);
  }
  if (import) reading.good = finish_import(*import, text, version, stop);
  version.export_ms = text.export_ms;
  version.read_ms = text.read_ms;
  version.files = std::move(text.files);
  version.design = reading.good.design;
  add_imported_files(*version.design, version.files);
  version.csg = reading.good.csg;
  version.nodes = reading.good.nodes;
  for (const Warning& warning : version.design->warnings) {
    version.messages.push_back(warning.text);
  }
}

/// Does the work, and reports in the version why it fails.
template <typename Work>
void report_failures(const std::string& path, DesignReading& reading, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    reading.version.error = error.what();
  } catch (const std::bad_alloc&) {
    reading.version.error = path + ": error: out of memory (try a smaller design)";
  } catch (const std::exception& error) {
    reading.version.error = path + ": error: " + error.what();
  }
}

/// Imports the text of the good version again. The messages before the importer's stay.
void render_into(DesignReading& reading, const std::string& path, const DesignFileOptions& options,
                 const std::stop_token& stop) {
  DesignVersion& version = reading.version;
  version.messages.resize(version.messages.size() - version.design->warnings.size());
  DesignText text;
  text.is_exported = reading.good.is_exported;
  TextImport import(reading.good.csg->view(), reading.good.text_name,
                    beside(path, text, options.import), stop);
  reading.good.design = std::make_shared<const ImportedDesign>(import.finish(stop));
  version.design = reading.good.design;
  version.unchanged = false;
  for (const Warning& warning : version.design->warnings) {
    version.messages.push_back(warning.text);
  }
}

}  // namespace

DesignReading read_anew(const std::string& path, const DesignFileOptions& options,
                        const GoodVersion& before, const std::stop_token& stop) {
  DesignReading reading;
  reading.good = before;
  report_failures(path, reading, [&] { read_into(reading, path, options, stop); });
  return reading;
}

DesignReading render_missing(const std::string& path, const DesignFileOptions& options,
                             const DesignReading& before, const std::stop_token& stop) {
  DesignReading reading = before;
  report_failures(path, reading, [&] { render_into(reading, path, options, stop); });
  return reading;
}

}  // namespace frontend
