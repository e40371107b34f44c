#include "base/resolved_path.hpp"

#include <system_error>

namespace language {

namespace fs = std::filesystem;

fs::path resolved(const fs::path& path) {
  std::error_code failed;
  fs::path result = fs::weakly_canonical(path, failed);
  return failed ? path.lexically_normal() : result;
}

fs::path resolved_file(const fs::path& path) {
  const fs::path name = path.filename();
  if (name.empty() || name == "." || name == "..") return resolved(path);
  return resolved(path.parent_path()) / name;
}

}  // namespace language
