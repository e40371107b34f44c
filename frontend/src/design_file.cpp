#include "frontend/design_file.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "elapsed.hpp"
#include "frontend/error.hpp"
#include "frontend/openscad_export.hpp"
#include "frontend/parser.hpp"

namespace frontend {

bool is_scad(const std::string& path) {
  constexpr std::string_view kSuffix = ".scad";
  return path.size() >= kSuffix.size() &&
         std::equal(kSuffix.begin(), kSuffix.end(), path.end() - kSuffix.size(),
                    [](char wanted, char c) {
                      return wanted == std::tolower(static_cast<unsigned char>(c));
                    });
}

DesignText read_design_text(const std::string& path, const DesignFileOptions& options,
                            const std::stop_token& stop) {
  DesignText text;
  const Clock::time_point start = Clock::now();
  text.csg = read_file(path, stop);  // a .scad, too, to see that it can be read
  text.read_ms = ms_since(start);
  text.name = path == "-" ? "standard input" : path;
  text.is_exported = is_scad(path);
  if (text.is_exported) {
    // Places in an exported design are not those of the .scad, and must not look as if they were.
    text.name += " (its .csg)";
    const Clock::time_point export_start = Clock::now();
    OpenScadExport result = export_with_openscad(
        path, options.openscad_arguments, options.wants_files, options.message,
        [&options] { options.progress("openscad"); }, stop);
    text.csg = std::move(result.csg);
    text.files = std::move(result.files);
    text.export_ms = ms_since(export_start);
  } else if (options.wants_files && path != "-") {
    text.files = {path};
  }
  return text;
}

DesignFile read_design(const std::string& path, const DesignFileOptions& options) {
  DesignText text = read_design_text(path, options);
  if (text.is_exported && options.wants_files && text.files.empty()) {
    throw Error(path, {}, "openscad does not say which files it reads",
                "leave out -d, or check $OPENSCAD");
  }
  DesignFile design;
  design.name = path == "-" ? "standard input" : path;
  design.is_exported = text.is_exported;
  design.files = std::move(text.files);
  design.export_ms = text.export_ms;
  design.read_ms = text.read_ms;
  design.file_bytes = text.csg.view().size();
  options.progress("parsing");
  const Clock::time_point parse_start = Clock::now();
  design.tree = parse(text.csg.view(), text.name);
  design.parse_ms = ms_since(parse_start);
  return design;
}

}  // namespace frontend
