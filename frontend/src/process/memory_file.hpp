// A file that lies in memory alone.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>

#include "base/descriptor.hpp"

namespace frontend {

/// A file in memory, without a name. Programs that are started inherit it only if they are given
/// its descriptor.
class MemoryFile {
 public:
  /// Throws std::system_error.
  MemoryFile() : file_(memfd_create("scadray", MFD_CLOEXEC)) {
    if (file_.number() < 0) fail();
  }
  /// A file that holds the text, and is read from its start. Throws std::system_error.
  explicit MemoryFile(std::string_view text) : MemoryFile() {
    while (!text.empty()) {
      const ssize_t count = write(file_.number(), text.data(), text.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail();
      text.remove_prefix(static_cast<std::size_t>(count));
    }
    if (lseek(file_.number(), 0, SEEK_SET) != 0) fail();
  }

  int descriptor() const { return file_.number(); }
  /// A path by which a child that inherits the file can open it.
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_.number()); }

 private:
  [[noreturn]] static void fail() {
    throw std::system_error(errno, std::generic_category(), "a file in memory");
  }
  Descriptor file_;
};

}  // namespace frontend
