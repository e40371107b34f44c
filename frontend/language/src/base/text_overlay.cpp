#include "language/text_overlay.hpp"

#include <filesystem>
#include <system_error>

#include "base/read_file.hpp"

namespace language {

std::string TextOverlay::key_of(const std::string& path) {
  std::error_code failed;
  return resolved(std::filesystem::absolute(path, failed)).string();
}

}  // namespace language
