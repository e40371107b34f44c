#include "frontend/design_kind.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "lower/import_files.hpp"

namespace frontend {
namespace {

/// `suffix` is in lower case.
bool has_suffix(const std::string& path, std::string_view suffix) {
  return path.size() >= suffix.size() &&
         std::equal(suffix.begin(), suffix.end(), path.end() - static_cast<long>(suffix.size()),
                    [](char wanted, char c) {
                      return wanted == std::tolower(static_cast<unsigned char>(c));
                    });
}

}  // namespace

DesignKind kind_of(const std::string& path) {
  if (has_suffix(path, ".scad")) return DesignKind::kScad;
  if (has_suffix(path, ".csg")) return DesignKind::kCsg;
  return is_importable(path) ? DesignKind::kImported : DesignKind::kEither;
}

}  // namespace frontend
