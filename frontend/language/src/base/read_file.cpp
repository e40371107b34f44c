#include "base/read_file.hpp"

#include <fcntl.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

namespace language {

namespace {

std::optional<std::string> read_all(std::FILE* opened, const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(opened, std::fclose);
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

}  // namespace

std::optional<std::string> read_file(const std::string& path) {
  return read_all(std::fopen(path.c_str(), "rb"), path);
}

bool is_regular_file(const std::string& path) {
  std::error_code failed;
  return std::filesystem::is_regular_file(path, failed);
}

std::optional<std::string> read_regular_file(const std::string& path) {
  if (!is_regular_file(path)) return std::nullopt;
  // A pipe that has taken its place since then is not waited for, and read as empty.
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  return descriptor < 0 ? std::nullopt : read_all(fdopen(descriptor, "rb"), path);
}

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
