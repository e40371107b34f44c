#include "frontend/design_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <new>
#include <set>
#include <string_view>
#include <system_error>

#include "base/elapsed.hpp"
#include "follow/evaluated_design.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/openscad_export.hpp"
#include "frontend/parser.hpp"
#include "language/parameter_set_file.hpp"
#include "process/memory_file.hpp"
#include "solids/import_files.hpp"

namespace frontend {

namespace {

DesignFile read_and_parse(const std::string& path, const DesignFileOptions& options) {
  DesignText text = read_design_text(path, options);
  options.progress("parsing");
  const Clock::time_point parse_start = Clock::now();
  DesignFile design{.tree = tree_of(text)};
  design.name = input_name(path);
  design.parse_ms = ms_since(parse_start);
  if (text.is_exported && options.wants_files && text.files.empty()) {
    throw Error(path, {}, "openscad does not say which files it reads",
                "leave out -d, or check $SCADRAY_OPENSCAD and $OPENSCAD");
  }
  design.import = beside(path, text, options.import);
  design.is_exported = text.is_exported;
  if (options.wants_files) design.files = std::move(text.files);
  design.export_ms = text.export_ms;
  design.read_ms = text.read_ms;
  design.file_bytes = text.csg.view().size();
  if (text.evaluation) design.camera = camera_of(*text.evaluation);
  if (options.wants_text) design.text = std::move(text);
  return design;
}

/// Returns the absolute path of a file; nothing of the standard input.
std::string absolute_path(const std::string& path) {
  if (path == "-") return {};
  std::error_code failed;  // the working folder is gone
  const std::filesystem::path absolute = std::filesystem::absolute(path, failed);
  return failed ? std::string() : absolute.lexically_normal().string();
}

/// Assigns $t, exact to the last bit.
std::string time_assignment(double time) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), time).ptr;
  return "$t=" + std::string(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

/// The most bytes of a text that may be a .scad's alone. Published designs have up to some 20 MB; a
/// pipe may be endless.
constexpr std::size_t kMostScadBytes = std::size_t{64} << 20;

/// Reads the text of a .csg or a .scad. Throws Error for what can be neither.
FileText read_text(const std::string& path, const std::stop_token& stop) {
  const DesignKind kind = kind_of(path);
  const auto is_no_csg = [&](std::string_view start, const std::stop_token& stop_parsing) {
    return kind == DesignKind::kScad || is_beyond_repair(start, stop_parsing);
  };
  FileText text = read_file(path, is_no_csg, stop, kMostScadBytes + 1);
  if (kind == DesignKind::kCsg) return text;  // its parser says what is wrong, and where
  if (kind != DesignKind::kScad && text.view().find('\0') != std::string_view::npos) {
    throw Error(input_name(path), {}, "is no design",
                std::string("give a .scad, a .csg, or what import() reads: ") + kImportable);
  }
  if (text.view().size() > kMostScadBytes && is_no_csg(text.view(), stop)) {
    throw Error(input_name(path), {}, "is larger than 64 MiB, and no .csg", "check the file");
  }
  return text;
}

/// Returns whether a design is a .csg, which is not evaluated. `text.scad` is what text_in_memory()
/// gives. Sets `text.tree` where the name does not tell, and the text had to be parsed.
bool is_csg(const std::string& path, const DesignFileOptions& options, DesignText& text,
            const std::stop_token& stop) {
  const DesignKind kind = kind_of(path);
  if (kind != DesignKind::kEither) return kind == DesignKind::kCsg;
  // --hardwarnings means something to the reader of a .csg, too.
  const bool has_options =
      std::any_of(options.openscad_arguments.begin(), options.openscad_arguments.end(),
                  [](const std::string& word) { return word != "--hardwarnings"; });
  if (has_options || !text.scad) return !has_options;
  try {
    text.tree = parse(*text.scad, text.name, absolute_path(path), stop);
    return true;
  } catch (const Error&) {
    return false;
  }
}

constexpr const char* kSetName = "scadray";

/// Returns the text of a file with this set alone.
std::string parameter_file(const language::ParameterSet& set) {
  language::ParameterSetFile file;
  static_cast<void>(file.put(kSetName, set));  // a new file can hold sets
  return file.text();
}

/// Replaces -p and -P by the set in a file that parameter_file() has made.
void replace_parameter_set(std::vector<std::string>& arguments, const MemoryFile& file) {
  for (std::size_t i = 0; i + 1 < arguments.size();) {
    const auto at = arguments.begin() + static_cast<long>(i);
    if (*at == "-p" || *at == "-P") {
      arguments.erase(at, at + 2);
    } else {
      i += *at == "-D" ? 2 : 1;
    }
  }
  // The path leads to this program's file: openscad inherits no more than one.
  const std::string path =
      "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file.descriptor());
  arguments.insert(arguments.end(), {"-p", path, "-P", kSetName});
}

/// Returns what `work` returns, and turns a lack of memory into an Error about the design.
template <typename Work>
auto within_memory(const std::string& path, Work work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw Error(input_name(path), {}, "out of memory", "try a smaller design");
  }
}

/// Evaluates the design.
void export_design_text(const std::string& path, const DesignFileOptions& options, DesignText& text,
                        const std::stop_token& stop) {
  text.is_exported = true;
  const Clock::time_point start = Clock::now();
  if (options.evaluator == Evaluator::kOwn || kind_of(path) == DesignKind::kImported) {
    options.progress("evaluating");
    text.evaluation = evaluate_design(path, text.scad, options, stop);
    text.export_ms = ms_since(start);
    if (text.evaluation) {
      text.files = files_of(*text.evaluation, path);
      return;
    }
  }
  // Places in the exported text must not look like places in the .scad.
  text.name = input_name(path) + " (its .csg)";
  std::vector<std::string> arguments = options.openscad_arguments;
  if (options.import.picture == PictureKind::kRendered) {
    // An export to .csg is a preview for OpenSCAD. Of several -D the last one counts.
    arguments.insert(arguments.begin(), {"-D", "$preview=false"});
  }
  if (options.inputs.time) {
    arguments.insert(arguments.end(), {"-D", time_assignment(*options.inputs.time)});
  }
  std::optional<MemoryFile> parameters;
  if (options.inputs.parameters) {
    parameters.emplace(parameter_file(*options.inputs.parameters));
    replace_parameter_set(arguments, *parameters);
  }
  OpenScadExport result = export_with_openscad(
      path, arguments, options.message, [&options] { options.progress("openscad"); }, stop,
      is_read_once(path) ? text.scad : std::nullopt);
  text.csg = std::move(result.csg);
  text.files = std::move(result.files);
  if (options.wants_files && is_read_once(path)) text.files.push_back(path);  // openscad reads "-"
  text.export_ms = ms_since(start);
}

}  // namespace

std::optional<FileText> text_in_memory(const std::string& path, const std::stop_token& stop) {
  std::error_code failed;
  if (path != "-" && !std::filesystem::exists(path, failed)) return std::nullopt;
  const DesignKind kind = kind_of(path);
  if (kind == DesignKind::kImported) {
    check_input(path);
    if (is_read_once(path)) throw Error(path, {}, "is no regular file", "check the file");
    return FileText(import_of(std::filesystem::path(path).filename()));
  }
  if (kind != DesignKind::kEither && !is_read_once(path)) return std::nullopt;
  if (kind == DesignKind::kScad) check_input(path);
  return read_text(path, stop);
}

ImportOptions beside(const std::string& path, const DesignText& text, ImportOptions options) {
  options.folder = path == "-" ? "" : std::filesystem::path(path).parent_path().string();
  if (text.is_exported) {
    options.font_files = [fonts = fonts_of(text.evaluation ? text.evaluation->files_read
                                                           : text.files)] { return fonts; };
  }
  return options;
}

void add_imported_files(const ImportedDesign& design, std::vector<std::string>& files) {
  if (files.empty()) return;
  const auto absolute = [](const std::string& path) {
    std::error_code failed;
    return std::filesystem::absolute(path, failed).lexically_normal().string();
  };
  std::set<std::string> known;
  for (const std::string& file : files) known.insert(absolute(file));
  std::string path = std::move(files.back());
  files.pop_back();
  for (const std::string& file : design.files) {
    if (known.insert(absolute(file)).second) files.push_back(file);
  }
  files.push_back(std::move(path));
}

std::vector<NamedPath> design_inputs(const std::string& path,
                                     const std::vector<std::string>& openscad_arguments) {
  std::vector<NamedPath> inputs = {{"the design", path}};
  for (std::size_t i = 0; i + 1 < openscad_arguments.size(); ++i) {
    if (openscad_arguments[i] == "-p")
      inputs.push_back({"what -p reads", openscad_arguments[i + 1]});
  }
  return inputs;
}

DesignText read_design_text(const std::string& path, const DesignFileOptions& options,
                            const std::stop_token& stop) {
  DesignText text;
  const Clock::time_point start = Clock::now();
  text.name = input_name(path);
  text.scad = options.text ? options.text : text_in_memory(path, stop);
  if (!is_csg(path, options, text, stop)) {
    if (!text.scad) check_input(path);
    text.read_ms = ms_since(start);
    export_design_text(path, options, text, stop);
    return text;
  }
  text.csg = text.scad ? *text.scad : read_file(path, is_beyond_repair, stop);
  text.csg_path = absolute_path(path);
  text.read_ms = ms_since(start);
  if (options.wants_files) text.files = {path};
  return text;
}

DesignFile read_design(const std::string& path, const DesignFileOptions& options) {
  return within_memory(path, [&] { return read_and_parse(path, options); });
}

DesignTree tree_of(const DesignText& text, const std::stop_token& stop) {
  if (text.tree) return *text.tree;
  if (text.evaluation) return tree_of(*text.evaluation, text.name);
  return parse(text.csg, text.name, text.csg_path, stop);
}

ImportedDesign import_design(const DesignFile& file) {
  return within_memory(file.name, [&] { return import_design(file.tree, file.import); });
}

}  // namespace frontend
