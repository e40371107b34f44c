#include "base/read_file.hpp"

#include <cstdio>
#include <memory>

namespace language {

std::optional<std::string> read_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) return std::nullopt;
  std::string bytes;
  size_t count = 0;
  do {
    constexpr size_t kBlock = 1 << 16;  // bytes: most designs are read at once
    const size_t size = bytes.size();
    bytes.resize(size + kBlock);
    count = std::fread(bytes.data() + size, 1, kBlock, file.get());
    bytes.resize(size + count);
    if (bytes.size() > kMostFileBytes) return std::nullopt;
  } while (count > 0);
  if (std::ferror(file.get())) return std::nullopt;  // a folder can be opened, but not read
  return bytes;
}

}  // namespace language
