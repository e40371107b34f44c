#include "frontend/design_file.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "elapsed.hpp"
#include "frontend/files.hpp"
#include "frontend/openscad_export.hpp"
#include "frontend/parser.hpp"

namespace frontend {
namespace {

/// `suffix` in lower case.
bool has_suffix(const std::string& path, std::string_view suffix) {
  if (path.size() < suffix.size()) return false;
  return std::equal(
      suffix.begin(), suffix.end(), path.end() - static_cast<long>(suffix.size()),
      [](char wanted, char c) { return wanted == std::tolower(static_cast<unsigned char>(c)); });
}

}  // namespace

DesignFile read_design(const std::string& path, const DesignFileOptions& options) {
  DesignFile design;
  design.name = path == "-" ? "standard input" : path;
  const Clock::time_point start = Clock::now();
  FileText text = read_file(path);  // a .scad, too, to see that it can be read
  design.read_ms = ms_since(start);
  design.is_exported = has_suffix(path, ".scad");
  if (design.is_exported) {
    const Clock::time_point export_start = Clock::now();
    OpenScadExport result =
        export_with_openscad(path, options.openscad_arguments, options.wants_files, options.message,
                             [&options] { options.progress("openscad"); });
    text = std::move(result.csg);
    design.files = std::move(result.files);
    design.export_ms = ms_since(export_start);
  } else if (options.wants_files && path != "-") {
    design.files = {path};
  }
  design.file_bytes = text.view().size();
  options.progress("parsing");
  const Clock::time_point parse_start = Clock::now();
  // Places in an exported design are not those of the .scad, and must not look as if they were.
  design.tree = parse(text.view(), design.is_exported ? design.name + " (its .csg)" : design.name);
  design.parse_ms = ms_since(parse_start);
  return design;
}

}  // namespace frontend
