#include "command/output_paths.hpp"

#include <algorithm>
#include <filesystem>

#include "follow/make_rule.hpp"

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

uint32_t frame_count(const Options& options) { return std::max(options.frames, 1u); }

std::optional<double> frame_time(const Options& options, uint32_t frame) {
  if (options.frames == 0) return std::nullopt;
  return static_cast<double>(frame) / options.frames;
}

std::string path_of(const Output& output, const Options& options, uint32_t frame) {
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

}  // namespace frontend
