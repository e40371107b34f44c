#include "frontend/design_file.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "elapsed.hpp"
#include "frontend/error.hpp"
#include "frontend/openscad_export.hpp"

namespace frontend {

namespace {

/// `suffix` in lower case.
bool has_suffix(const std::string& path, std::string_view suffix) {
  return path.size() >= suffix.size() &&
         std::equal(suffix.begin(), suffix.end(), path.end() - static_cast<long>(suffix.size()),
                    [](char wanted, char c) {
                      return wanted == std::tolower(static_cast<unsigned char>(c));
                    });
}

/// A regular file of another name may be either: editors' plugins hand over temporary files without
/// a suffix. What can be read only once is a .csg.
bool may_be_scad(const std::string& path) {
  std::error_code failed;
  return !has_suffix(path, ".csg") && std::filesystem::is_regular_file(path, failed);
}

void export_design(const std::string& path, const DesignFileOptions& options, DesignText& text,
                   const std::stop_token& stop) {
  text.is_exported = true;
  // Places in an exported design are not those of the .scad, and must not look as if they were.
  text.name = path + " (its .csg)";
  const Clock::time_point start = Clock::now();
  OpenScadExport result = export_with_openscad(
      path, options.openscad_arguments, options.wants_files, options.message,
      [&options] { options.progress("openscad"); }, stop);
  text.csg = std::move(result.csg);
  text.files = std::move(result.files);
  text.export_ms = ms_since(start);
}

/// Parses what may turn out to be a .scad.
TextImport parse_either(const std::string& path, const DesignFileOptions& options,
                        DesignText& text) {
  try {
    return TextImport(text.csg.view(), text.name, options.import);
  } catch (const Error&) {
    if (path == "-" || text.is_exported || !may_be_scad(path)) throw;
  }
  export_design(path, options, text, {});
  options.progress("parsing");
  return TextImport(text.csg.view(), text.name, options.import);
}

}  // namespace

bool is_scad(const std::string& path) { return has_suffix(path, ".scad"); }

DesignText read_design_text(const std::string& path, const DesignFileOptions& options,
                            const std::stop_token& stop) {
  DesignText text;
  const Clock::time_point start = Clock::now();
  text.csg = read_file(path, stop);  // a .scad, too, to see that it can be read
  text.read_ms = ms_since(start);
  text.name = path == "-" ? "standard input" : path;
  if (is_scad(path)) {
    export_design(path, options, text, stop);
  } else if (options.wants_files && path != "-") {
    text.files = {path};
  }
  return text;
}

DesignFile read_design(const std::string& path, const DesignFileOptions& options) {
  DesignText text = read_design_text(path, options);
  options.progress("parsing");
  const double export_before_ms = text.export_ms;
  const Clock::time_point parse_start = Clock::now();
  DesignFile design{.import = parse_either(path, options, text)};
  design.name = path == "-" ? "standard input" : path;
  design.parse_ms = ms_since(parse_start) - (text.export_ms - export_before_ms);
  if (text.is_exported && options.wants_files && text.files.empty()) {
    throw Error(path, {}, "openscad does not say which files it reads",
                "leave out -d, or check $OPENSCAD");
  }
  design.is_exported = text.is_exported;
  design.files = std::move(text.files);
  design.export_ms = text.export_ms;
  design.read_ms = text.read_ms;
  design.file_bytes = text.csg.view().size();
  return design;
}

}  // namespace frontend
