#include "base/read_file.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>

namespace language {

std::optional<std::string> read_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) return std::nullopt;
  constexpr size_t kBlock = 1 << 16;  // bytes of what has no size, and grows as it is read
  std::error_code problem;
  const auto size = std::filesystem::file_size(path, problem);
  const bool is_sized = !problem && size <= kMostFileBytes;
  std::string bytes(is_sized ? size + 1 : kBlock, '\0');  // more than there are
  size_t count = 0;
  for (;;) {
    count += std::fread(bytes.data() + count, 1, bytes.size() - count, file.get());
    if (count > kMostFileBytes) return std::nullopt;
    if (count < bytes.size()) break;
    bytes.resize(2 * count);
  }
  if (std::ferror(file.get())) return std::nullopt;  // a folder can be opened, but not read
  bytes.resize(count);
  return bytes;
}

}  // namespace language
