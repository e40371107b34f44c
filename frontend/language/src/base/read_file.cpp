#include "base/read_file.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>

namespace language {

std::optional<std::string> read_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) return std::nullopt;
  constexpr size_t kBlock = 1 << 16;  // bytes: most designs are read at once
  const auto block = std::make_unique_for_overwrite<char[]>(kBlock);
  std::string bytes;
  std::error_code problem;  // what has no size is no file, and grows as it is read
  const auto size = std::filesystem::file_size(path, problem);
  if (!problem && size <= kMostFileBytes) bytes.reserve(size);
  while (const size_t count = std::fread(block.get(), 1, kBlock, file.get())) {
    bytes.append(block.get(), count);
    if (bytes.size() > kMostFileBytes) return std::nullopt;
  }
  if (std::ferror(file.get())) return std::nullopt;  // a folder can be opened, but not read
  return bytes;
}

}  // namespace language
