// Tells whether a file has changed, without reading it.
#pragma once

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <tuple>

namespace language {

/// Two signatures of one path are equal as long as nobody writes to the file, replaces it, or
/// changes its permissions. (A file that is written to twice within a tick of the file system's
/// clock may keep its signature.)
class FileSignature {
 public:
  /// The signature of a missing file.
  FileSignature() = default;
  /// Links are followed. A file that cannot be examined counts as missing.
  explicit FileSignature(const std::string& path) {
    const int64_t now_ns = nanoseconds(std::chrono::system_clock::now());
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) return;
    exists_ = true;
    is_regular_ = S_ISREG(status.st_mode);
    size_ = status.st_size;
    changed_ns_ = nanoseconds(status.st_ctim);
    const int64_t written_ns = nanoseconds(status.st_mtim);
    is_settled_ = std::max(written_ns, changed_ns_) + kCoarsestClock_ns < now_ns;
    identity_ = {status.st_dev, status.st_ino, status.st_mode, written_ns};
  }

  bool exists() const { return exists_; }
  bool is_regular() const { return is_regular_; }
  bool is_empty() const { return size_ == 0; }
  /// When the file was last written to, renamed, linked or the like, in ns of the system's clock.
  int64_t changed_ns() const { return changed_ns_; }

  bool operator==(const FileSignature& other) const {
    return exists_ == other.exists_ && size_ == other.size_ && identity_ == other.identity_;
  }
  /// Returns whether the file has, for certain, the same bytes as when `earlier` was taken: it had
  /// not changed for so long then that every later change shows.
  bool has_bytes_of(const FileSignature& earlier) const {
    return earlier.is_settled_ && *this == earlier && changed_ns_ == earlier.changed_ns_;
  }

 private:
  static constexpr int64_t kCoarsestClock_ns = 3'000'000'000;  // FAT counts two seconds

  static int64_t nanoseconds(const timespec& time) {
    return int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  }
  static int64_t nanoseconds(std::chrono::system_clock::time_point time) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
  }

  bool exists_ = false;
  bool is_regular_ = false;
  bool is_settled_ = false;
  int64_t size_ = 0;
  int64_t changed_ns_ = 0;
  std::tuple<dev_t, ino_t, mode_t, int64_t> identity_{};
};

}  // namespace language
