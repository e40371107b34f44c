#include "command/outputs.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "follow/evaluated_design.hpp"
#include "follow/make_rule.hpp"
#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/openscad_export.hpp"
#include "frontend/terminal.hpp"
#include "language/csg_writer.hpp"
#include "language/customizer.hpp"
#include "language/evaluation.hpp"
#include "process/child_process.hpp"
#include "process/memory_file.hpp"
#include "process/openscad_program.hpp"

namespace frontend {
namespace {

std::string frame_path(const std::string& path, const Options& options, uint32_t frame) {
  if (options.frames == 0) return path;
  const std::filesystem::path whole(path);
  std::string digits = std::to_string(frame);
  digits.insert(0, 5 - std::min<std::size_t>(digits.size(), 5), '0');
  return (whole.parent_path() / (whole.stem().string() + digits + whole.extension().string()))
      .string();
}

const char* word_of(TextKind kind) {
  return kind == TextKind::kCsg ? "csg" : kind == TextKind::kEcho ? "echo" : "param";
}

/// Returns the command of openscad that writes the output.
std::vector<std::string> openscad_command(const Options& options, const TextOutput& output,
                                          const std::string& input) {
  std::vector<std::string> command = {openscad_program(), "-o", output.path,
                                      "--export-format=" + std::string(word_of(output.kind))};
  if (options.quiet) command.push_back("-q");
  if (options.import.picture == PictureKind::kRendered) command.push_back("--render");
  if (!options.rule_path.empty()) command.insert(command.end(), {"-d", options.rule_path});
  command.insert(command.end(), options.openscad_arguments.begin(),
                 options.openscad_arguments.end());
  if (options.frames > 0) command.push_back("--animate=" + std::to_string(options.frames));
  command.insert(command.end(), {"--", input});
  return command;
}

ExitCode write_by_openscad(const Options& options, const TextOutput& output,
                           const std::optional<FileText>& text) {
  std::fflush(stdout);
  std::optional<MemoryFile> input;
  if (text && is_read_once(options.input)) input.emplace(text->view());
  const MemoryFile for_terminal;  // which must get nothing that steers it
  const bool is_out_shown = isatty(STDOUT_FILENO) == 1, is_err_shown = isatty(STDERR_FILENO) == 1;
  ChildProcess openscad({.command = openscad_command(options, output, input ? "-" : options.input),
                         .output = is_out_shown ? for_terminal.descriptor() : STDOUT_FILENO,
                         .errors = is_err_shown ? for_terminal.descriptor() : STDERR_FILENO,
                         .input = input ? input->descriptor() : -1});
  const int exit_code = openscad.wait();
  if (lseek(for_terminal.descriptor(), 0, SEEK_SET) == 0) {
    const FileText said = read_descriptor(for_terminal.descriptor(), "a file in memory");
    print_text(is_err_shown ? stderr : stdout, said.view());
  }
  return exit_code == 0 ? ExitCode::kDone : ExitCode::kFailure;
}

/// The evaluations for one output, and where their messages go.
class TextRun {
 public:
  TextRun(const Options& options, const TextOutput& output, const std::optional<FileText>& text)
      : options_(options), output_(output), text_(text) {}

  ExitCode run() {
    std::optional<language::EvaluationOptions> known =
        evaluation_options(options_.openscad_arguments, options_.input);
    const bool wants_openscad = options_.evaluator == Evaluator::kOpenScad;
    if (!known || (wants_openscad && kind_of(options_.input) != DesignKind::kImported)) {
      return write_by_openscad(options_, output_, text_);
    }
    known->language = options_.import.language;
    known->camera = camera_choice(options_);
    known->view = view_of(options_);
    known->is_preview = options_.import.picture != PictureKind::kRendered;
    bool is_read = true;
    for (uint32_t frame = 0; is_read && frame < frame_count(options_); ++frame) {
      is_read = evaluate(*known, frame);
    }
    if (output_.kind == TextKind::kEcho) outputs_.push_back({output_.path, bytes_of(messages_)});
    const bool is_last = options_.models.empty() && options_.outputs.empty();
    if (is_read && !options_.rule_path.empty() && is_last) {
      outputs_.push_back({options_.rule_path, bytes_of(rule_of(options_, files_))});
    }
    if (is_read || output_.kind == TextKind::kEcho) write_outputs(outputs_);
    return is_read ? ExitCode::kDone : ExitCode::kFailure;
  }

 private:
  /// The messages of a tree go to stderr.
  void add(std::string_view line) {
    if (options_.quiet && !line.starts_with("ERROR")) return;
    messages_.append(line) += '\n';
    if (output_.kind == TextKind::kEcho) return;
    print_text(stderr, messages_);
    messages_.clear();
  }

  std::string parameters_of(const language::Evaluation& evaluation) const {
    const language::SourceFiles& files = *evaluation.files;
    const auto parameters = language::customizer_parameters(files[files.order().front()].text,
                                                            options_.import.language);
    return language::parameters_text(
        parameters.value_or(std::vector<language::CustomizerParameter>{}),
        std::filesystem::path(options_.input).stem().string());
  }

  /// Returns whether the design could be read.
  bool evaluate(language::EvaluationOptions options, uint32_t frame) {
    options.time = frame_time(options_, frame).value_or(0);
    if (output_.kind == TextKind::kEcho && options_.frames > 0) {
      add("Exporting " + (options_.input == "-" ? "<stdin>" : options_.input) + "...");
    }
    const language::Evaluation evaluation = language::evaluate(
        options_.input, options, [&](std::string_view line) { add(line); }, view_of(text_));
    const std::string advice =
        advice_of_language(options_.input, options, evaluation.outcome, view_of(text_));
    if (!advice.empty() && !options_.quiet) print_text(stderr, advice + "\n");
    if (evaluation.outcome == language::Outcome::kNotParsed ||
        evaluation.outcome == language::Outcome::kUnreadable) {
      return false;
    }
    if (output_.kind == TextKind::kParam) {
      outputs_.push_back({path_of(output_, options_, frame), bytes_of(parameters_of(evaluation))});
    }
    if (output_.kind == TextKind::kCsg) {
      outputs_.push_back(
          {path_of(output_, options_, frame), bytes_of(language::csg_text(*evaluation.tree))});
    }
    for (std::string& file : files_of(evaluation, options_.input)) {
      if (std::find(files_.begin(), files_.end(), file) == files_.end()) {
        files_.push_back(std::move(file));
      }
    }
    return true;
  }

  const Options& options_;
  const TextOutput& output_;
  const std::optional<FileText>& text_;
  std::string messages_;            // which are the output, or a line that is being said
  std::vector<std::string> files_;  // that the design was read from, for all frames
  std::vector<PendingOutput> outputs_;
};

}  // namespace

uint32_t frame_count(const Options& options) { return std::max(options.frames, 1u); }

std::optional<double> frame_time(const Options& options, uint32_t frame) {
  if (options.frames == 0) return std::nullopt;
  return static_cast<double>(frame) / options.frames;
}

std::string path_of(const Output& output, const Options& options, uint32_t frame) {
  return frame_path(output.path, options, frame);
}

std::string path_of(const ModelOutput& output, const Options& options, uint32_t frame) {
  return frame_path(output.path, options, frame);
}

std::string path_of(const TextOutput& output, const Options& options, uint32_t frame) {
  return output.kind == TextKind::kEcho ? output.path : frame_path(output.path, options, frame);
}

std::vector<NamedPath> output_paths(const Options& options) {
  std::vector<NamedPath> paths;
  for (const TextOutput& output : options.texts) {
    const uint32_t files = output.kind == TextKind::kEcho ? 1 : frame_count(options);
    for (uint32_t frame = 0; frame < files; ++frame) {
      paths.push_back({"-o", path_of(output, options, frame)});
    }
  }
  for (uint32_t frame = 0; frame < frame_count(options); ++frame) {
    for (const ModelOutput& output : options.models) {
      paths.push_back({"-o", path_of(output, options, frame)});
    }
    for (const Output& output : options.outputs) {
      paths.push_back({"-o", path_of(output, options, frame)});
    }
  }
  return paths;
}

std::string rule_of(const Options& options, std::vector<std::string> files) {
  std::vector<std::string> targets;
  for (NamedPath& output : output_paths(options)) {
    targets.push_back(output.path == "-" ? "<stdout>" : std::move(output.path));
  }
  std::erase(files, "-");  // make has no name for standard input
  return make_rule(targets, files);
}

ExitCode write_texts(const Options& options, const std::optional<FileText>& text) {
  if (options.texts.empty()) return ExitCode::kDone;
  std::vector<NamedPath> paths = output_paths(options);
  if (!options.rule_path.empty()) paths.push_back({"-d", options.rule_path});
  for (const NamedPath& path : paths) check_output(path.path);
  check_outputs_differ(paths, design_inputs(options.input, options.openscad_arguments));
  for (const TextOutput& output : options.texts) {
    const ExitCode code = TextRun(options, output, text).run();
    if (code != ExitCode::kDone) return code;
  }
  return ExitCode::kDone;
}

}  // namespace frontend
