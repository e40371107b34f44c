#include "design_reading.hpp"

#include <exception>
#include <new>
#include <utility>

#include "elapsed.hpp"
#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/stop.hpp"

namespace frontend {
namespace {

GoodVersion import_text(const std::string& name, std::shared_ptr<const FileText> csg,
                        const ImportOptions& options, DesignVersion& version,
                        const std::stop_token& stop) {
  const Clock::time_point parse_start = Clock::now();
  TextImport import(csg->view(), name, options, stop);
  version.parse_ms = ms_since(parse_start);
  const Clock::time_point import_start = Clock::now();
  auto design = std::make_shared<const ImportedDesign>(import.finish(stop));
  version.import_ms = ms_since(import_start);
  return {std::move(csg), std::move(design), import.nodes()};
}

void read_into(DesignReading& reading, const std::string& path, const FollowOptions& options,
               const std::stop_token& stop) {
  DesignVersion& version = reading.version;
  DesignFileOptions file_options;
  file_options.openscad_arguments = options.openscad_arguments;
  file_options.wants_files = true;
  file_options.message = [&version](const std::string& line) { version.messages.push_back(line); };
  file_options.progress = [](const char*) {};
  DesignText text = read_design_text(path, file_options, stop);
  version.export_ms = text.export_ms;
  version.read_ms = text.read_ms;
  version.unchanged = reading.good.design && reading.good.csg->view() == text.csg.view();
  if (!version.unchanged) {
    reading.good = import_text(text.name, std::make_shared<const FileText>(std::move(text.csg)),
                               options.import, version, stop);
  }
  version.files = std::move(text.files);
  version.design = reading.good.design;
  version.csg = reading.good.csg;
  version.nodes = reading.good.nodes;
  for (const Warning& warning : version.design->warnings) {
    version.messages.push_back(warning.text);
  }
}

}  // namespace

DesignReading read_anew(const std::string& path, const FollowOptions& options,
                        const GoodVersion& before, const std::stop_token& stop) {
  DesignReading reading;
  reading.good = before;
  try {
    read_into(reading, path, options, stop);
  } catch (const Error& error) {
    reading.version.error = error.what();
  } catch (const std::bad_alloc&) {
    reading.version.error = path + ": error: out of memory (try a smaller design)";
  } catch (const std::exception& error) {
    reading.version.error = path + ": error: " + error.what();
  }
  return reading;
}

}  // namespace frontend
