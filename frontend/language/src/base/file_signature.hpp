// Tells whether a file has changed, without reading it.
#pragma once

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <tuple>

namespace language {

/// Two equal signatures of a path mean that its bytes are the same, if the later one says so
/// itself.
class FileSignature {
 public:
  FileSignature() = default;
  /// Links are followed. A file that cannot be examined has the signature of no file.
  explicit FileSignature(const std::string& path) {
    const int64_t now_ns = nanoseconds(std::chrono::system_clock::now());
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) return;
    const int64_t written_ns = nanoseconds(status.st_mtim),
                  changed_ns = nanoseconds(status.st_ctim);
    identity_ = {status.st_dev, status.st_ino, status.st_size, written_ns, changed_ns};
    is_settled_ = std::max(written_ns, changed_ns) + kCoarsestClock_ns < now_ns;
  }

  /// Returns whether the file had not changed for so long that another change would show. A file
  /// that is written to twice within a tick of its file system's clock keeps its signature.
  bool is_settled() const { return is_settled_; }
  bool operator==(const FileSignature& other) const { return identity_ == other.identity_; }

 private:
  static constexpr int64_t kCoarsestClock_ns = 3'000'000'000;  // FAT counts two seconds

  static int64_t nanoseconds(const timespec& time) {
    return int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  }
  static int64_t nanoseconds(std::chrono::system_clock::time_point time) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
  }

  std::tuple<dev_t, ino_t, off_t, int64_t, int64_t> identity_{};
  bool is_settled_ = false;
};

}  // namespace language
