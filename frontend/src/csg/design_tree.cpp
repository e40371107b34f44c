#include "frontend/design_tree.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "language/evaluation.hpp"

namespace frontend {

std::string shown_name(const std::string& path) {
  std::error_code failed;
  const std::filesystem::path from_here =
      std::filesystem::path(path).lexically_relative(std::filesystem::current_path(failed));
  if (failed || from_here.empty() || *from_here.begin() == "..") return path;
  return from_here.string();
}

Location DesignTree::location_of(language::Place place) const {
  if (!files->has(place.file)) return {};
  return {files->line(place), files->column(place)};
}

std::string DesignTree::file_of(language::Place place) const {
  const bool is_other = place.file != 0 && files->has(place.file);
  return is_other ? shown_name((*files)[place.file].path) : name;
}

DesignTree tree_of(const language::Evaluation& evaluation, std::string name) {
  return {evaluation.tree, evaluation.files, std::move(name)};
}

}  // namespace frontend
