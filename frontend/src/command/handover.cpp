#include "command/handover.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "command/outputs.hpp"
#include "follow/evaluated_design.hpp"
#include "follow/make_rule.hpp"
#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/terminal.hpp"
#include "process/memory_file.hpp"
#include "process/openscad_program.hpp"

namespace frontend {
namespace {

/// Returns $t as openscad reads it.
std::string time_definition(double time) {
  std::array<char, 32> digits;
  return "$t=" + std::string(digits.data(),
                             std::to_chars(digits.data(), digits.data() + digits.size(), time).ptr);
}

/// Runs openscad, which may steer no terminal: what it says there is shown at its end. Returns its
/// exit code. `output` is what it writes.
int run_openscad(const std::vector<std::string>& command, const std::string& format,
                 const MemoryFile& output, const std::optional<MemoryFile>& input) {
  std::fflush(stdout);
  const MemoryFile for_terminal;
  const bool is_out_shown = isatty(STDOUT_FILENO) == 1, is_err_shown = isatty(STDERR_FILENO) == 1;
  ChildProcess openscad =
      start_openscad({.command = command,
                      .output = is_out_shown ? for_terminal.descriptor() : STDOUT_FILENO,
                      .errors = is_err_shown ? for_terminal.descriptor() : STDERR_FILENO,
                      .kept = output.descriptor(),
                      .input = input ? input->descriptor() : -1},
                     "a ." + format + " file is written by OpenSCAD");
  const int exit_code = openscad.wait();
  if (lseek(for_terminal.descriptor(), 0, SEEK_SET) == 0) {
    const FileText said = read_descriptor(for_terminal.descriptor(), "a file in memory");
    print_text(is_err_shown ? stderr : stdout, said.view());
  }
  return exit_code;
}

/// A design may say nothing, and a syntax tree have no node.
bool may_be_empty(const std::string& format) { return format == "echo" || format == "ast"; }

/// Adds what a frame gives to what is to be written: to one file for all frames if it is messages.
void add(const HandedOutput& output, uint32_t frame, std::string_view bytes, const Options& options,
         std::vector<PendingOutput>& written) {
  const std::string path = path_of(output, options, frame);
  if (written.empty() || written.back().path != path) written.push_back({path, {}});
  for (const std::vector<std::byte>& part :
       {bytes_of(exporting_line(output.format, options)), bytes_of(bytes)}) {
    written.back().bytes.insert(written.back().bytes.end(), part.begin(), part.end());
  }
}

/// Returns what openscad reads in place of the design's file: what can be read once, and for a mesh
/// or a drawing, which it does not open, a design that imports it.
std::optional<MemoryFile> input_of(const Options& options, const std::optional<FileText>& text) {
  if (kind_of(options.input) == DesignKind::kImported) {
    return std::optional<MemoryFile>(std::in_place,
                                     import_of(std::filesystem::absolute(options.input)));
  }
  if (!text || !is_read_once(options.input)) return std::nullopt;
  return std::optional<MemoryFile>(std::in_place, text->view());
}

/// One run of openscad's for an output and a frame.
class OpenScadRun {
 public:
  OpenScadRun(const Options& options, const std::vector<std::string>& arguments, bool writes_rule)
      : options_(options), arguments_(arguments), writes_rule_(writes_rule) {}

  /// Returns openscad's exit code.
  int write(const HandedOutput& output, uint32_t frame, const std::optional<FileText>& text) {
    std::vector<std::string> command = {openscad_program()};
    command.insert(command.end(), arguments_.begin(), arguments_.end());
    command.insert(command.end(), {"-o", file_.path(), "--export-format=" + output.format});
    if (const std::optional<double> time = frame_time(options_, frame)) {
      command.insert(command.end(), {"-D", time_definition(*time)});
    }
    if (writes_rule_) {
      // This program's path of the file: openscad inherits no more than one.
      command.insert(command.end(), {"-d", "/proc/" + std::to_string(getpid()) + "/fd/" +
                                               std::to_string(rule_.descriptor())});
    }
    const std::optional<MemoryFile> input = input_of(options_, text);
    command.insert(command.end(), {"--", input ? "-" : options_.input});
    return run_openscad(command, output.format, file_, input);
  }

  /// What was written.
  FileText bytes() const { return read_descriptor(file_.descriptor(), "a file in memory"); }
  /// The files that openscad names.
  std::vector<std::string> files() const {
    return prerequisites_of(read_descriptor(rule_.descriptor(), "a file in memory").view());
  }

 private:
  const Options& options_;
  const std::vector<std::string>& arguments_;
  const bool writes_rule_;
  // Nothing of files in memory is left if openscad fails or an interruption ends it.
  const MemoryFile file_, rule_;
};

}  // namespace

ExitCode write_by_openscad(const Options& options, std::span<const HandedOutput> outputs,
                           const std::vector<std::string>& arguments,
                           const std::optional<FileText>& text, bool writes_rule) {
  const std::vector<std::string> known = known_to_openscad(arguments, [&](const std::string& line) {
    if (!options.quiet) print_text(stderr, line + "\n");
  });
  std::vector<PendingOutput> written;
  std::vector<std::string> files;
  for (const HandedOutput& output : outputs) {
    for (uint32_t frame = options.first_frame; frame < options.end_frame; ++frame) {
      OpenScadRun run(options, known, writes_rule);
      const int exit_code = run.write(output, frame, text);
      if (exit_code != 0) return static_cast<ExitCode>(exit_code);
      const FileText bytes = run.bytes();
      if (bytes.view().empty() && !may_be_empty(output.format)) {
        throw Error(options.input, {}, "openscad wrote no ." + output.format,
                    "see what it says above");
      }
      add(output, frame, bytes.view(), options, written);
      for (std::string& name : run.files()) {
        if (std::find(files.begin(), files.end(), name) == files.end()) {
          files.push_back(std::move(name));
        }
      }
    }
  }
  if (writes_rule) written.push_back({options.rule_path, bytes_of(rule_of(options, files))});
  write_outputs(written);
  return ExitCode::kDone;
}

ExitCode write_handed(const Options& options, const std::optional<FileText>& text) {
  if (options.handed.empty()) return ExitCode::kDone;
  check_all_outputs(options);
  const bool has_others =
      !options.texts.empty() || !options.models.empty() || !options.outputs.empty();
  return write_by_openscad(options, options.handed, options.handed_arguments, text,
                           !options.rule_path.empty() && !has_others);
}

}  // namespace frontend
