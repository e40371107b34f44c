#include "command/outputs.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "follow/make_rule.hpp"
#include "frontend/design_file.hpp"
#include "frontend/design_version.hpp"
#include "frontend/terminal.hpp"

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

}  // namespace

const char* word_of(TextKind kind) {
  return kind == TextKind::kCsg ? "csg" : kind == TextKind::kEcho ? "echo" : "param";
}

std::string exporting_line(const std::string& format, const Options& options) {
  if (format != word_of(TextKind::kEcho) || options.frames == 0 || options.quiet) {
    return {};
  }
  return "Exporting " + (options.input == "-" ? "<stdin>" : options.input) + "...\n";
}

DesignMessageSink message_sink(const Options& options, MessageWriter& messages) {
  return [&](const DesignMessage& message) {
    if (options.prints_echoes && is_echo(message.text)) {
      print_text(stdout, message.text + "\n");
    } else if (!options.quiet || message.text.starts_with("ERROR")) {
      messages.say(message);
    }
  };
}

std::optional<double> frame_time(const Options& options, uint32_t frame) {
  if (options.frames == 0) return std::nullopt;
  return static_cast<double>(frame) / options.frames;
}

std::string path_of(const Output& output, const Options& options, uint32_t frame) {
  if (is_animated(output.format)) return output.path;
  return frame_path(output.path, options, frame);
}

std::string path_of(const ModelOutput& output, const Options& options, uint32_t frame) {
  return frame_path(output.path, options, frame);
}

std::string path_of(const HandedOutput& output, const Options& options, uint32_t frame) {
  return output.format == word_of(TextKind::kEcho) ? output.path
                                                   : frame_path(output.path, options, frame);
}

std::string path_of(const TextOutput& output, const Options& options, uint32_t frame) {
  return output.kind == TextKind::kEcho ? output.path : frame_path(output.path, options, frame);
}

namespace {

/// Returns the paths of all outputs of -o.
std::vector<NamedPath> output_paths(const Options& options) {
  std::vector<NamedPath> paths;
  const auto add = [&](const auto& output, uint32_t frame) {
    NamedPath path{"-o", path_of(output, options, frame)};
    const bool is_known =  // it has one file for all frames
        frame > options.first_frame && !paths.empty() && paths.back().path == path.path;
    if (!is_known) paths.push_back(std::move(path));
  };
  const auto add_each = [&](const auto& outputs) {
    for (const auto& output : outputs) {
      for (uint32_t i = options.first_frame; i < options.end_frame; ++i) add(output, i);
    }
  };
  add_each(options.handed);
  add_each(options.texts);
  for (uint32_t i = options.first_frame; i < options.end_frame; ++i) {
    for (const ModelOutput& output : options.models) add(output, i);
    for (const Output& output : options.outputs) {
      if (i == options.first_frame || !is_animated(output.format)) add(output, i);
    }
  }
  return paths;
}

}  // namespace

std::vector<NamedPath> named_outputs(const Options& options) {
  std::vector<NamedPath> outputs = output_paths(options);
  if (!options.stats_path.empty()) outputs.push_back({"--stats", options.stats_path});
  if (!options.summary_path.empty()) outputs.push_back({"--summary-file", options.summary_path});
  if (!options.rule_path.empty()) outputs.push_back({"-d", options.rule_path});
  return outputs;
}

void check_all_outputs(const Options& options) {
  const std::vector<NamedPath> outputs = named_outputs(options);
  for (const NamedPath& output : outputs) check_output(output.path);
  check_outputs_differ(outputs, design_inputs(options.input, options.openscad_arguments));
}

std::string rule_of(const Options& options, std::vector<std::string> files) {
  std::vector<std::string> targets;
  for (NamedPath& output : output_paths(options)) {
    targets.push_back(output.path == "-" ? "<stdout>" : std::move(output.path));
  }
  std::erase(files, "-");  // make has no name for standard input
  return make_rule(targets, files);
}

}  // namespace frontend
