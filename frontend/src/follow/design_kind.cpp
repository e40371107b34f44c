#include "frontend/design_kind.hpp"

#include <string_view>

#include "base/lower_case.hpp"
#include "solids/import_files.hpp"

namespace frontend {
namespace {

/// `suffix` is in lower case.
bool has_suffix(const std::string& path, std::string_view suffix) {
  return path.size() >= suffix.size() &&
         lower_case(path.substr(path.size() - suffix.size())) == suffix;
}

}  // namespace

DesignKind kind_of(const std::string& path) {
  if (has_suffix(path, ".scad")) return DesignKind::kScad;
  if (has_suffix(path, ".csg")) return DesignKind::kCsg;
  return is_importable(path) ? DesignKind::kImported : DesignKind::kEither;
}

}  // namespace frontend
