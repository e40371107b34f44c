// Tells whether a file has changed, without reading it.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <string>
#include <tuple>

namespace frontend {

/// Two signatures of one path are equal as long as nobody writes to the file, replaces it, or
/// changes its permissions. (A file that is written to twice within a tick of the file system's
/// clock may keep its signature.)
class FileSignature {
 public:
  /// The signature of a missing file.
  FileSignature() = default;
  /// Links are followed. A file that cannot be examined counts as missing.
  explicit FileSignature(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) return;
    exists_ = true;
    is_regular_ = S_ISREG(status.st_mode);
    size_ = status.st_size;
    changed_ns_ = nanoseconds(status.st_ctim);
    identity_ = {status.st_dev, status.st_ino, status.st_mode, nanoseconds(status.st_mtim)};
  }

  bool exists() const { return exists_; }
  bool is_regular() const { return is_regular_; }
  bool is_empty() const { return size_ == 0; }
  /// When the file was last written to, renamed, linked or the like, in ns of the system's clock.
  int64_t changed_ns() const { return changed_ns_; }

  bool operator==(const FileSignature& other) const {
    return exists_ == other.exists_ && size_ == other.size_ && identity_ == other.identity_;
  }

 private:
  static int64_t nanoseconds(const timespec& time) {
    return int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  }

  bool exists_ = false;
  bool is_regular_ = false;
  int64_t size_ = 0;
  int64_t changed_ns_ = 0;
  std::tuple<dev_t, ino_t, mode_t, int64_t> identity_{};
};

}  // namespace frontend
