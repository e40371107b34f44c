#include "frontend/files.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <deque>
#include <filesystem>
#include <optional>
#include <random>

#include "descriptor.hpp"
#include "frontend/error.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/stop.hpp"

namespace frontend {
namespace {

namespace fs = std::filesystem;

Error cannot_read(const std::string& name, int error_number) {
  return Error(name, {}, std::string("cannot be read: ") + std::strerror(error_number),
               error_number == ENOENT ? "check the file's name" : "check the file");
}

Error cannot_write(const std::string& path, int error_number) {
  return Error(path, {}, std::string("cannot be written: ") + std::strerror(error_number),
               "check the folder, its permissions and the space left");
}

/// The bytes to make room for at first, and the step by which room grows for what has no size.
constexpr std::size_t kFirstRoom = std::size_t{1} << 16;

/// Room that is not filled with zeros first: a .csg may have hundreds of MB.
struct Room {
  std::unique_ptr<char[]> bytes;
  std::size_t capacity = 0;
  std::size_t size = 0;

  void grow(std::size_t wanted) {
    auto larger = std::make_unique_for_overwrite<char[]>(wanted);
    if (size > 0) std::memcpy(larger.get(), bytes.get(), size);
    bytes = std::move(larger);
    capacity = wanted;
  }
};

void write_all(int descriptor, std::span<const std::byte> bytes, const std::string& name) {
  while (!bytes.empty()) {
    const ssize_t count = write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw cannot_write(name, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

bool is_standard_output(const std::string& path) {
  return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

/// Where the links of a chain end, which need not exist.
fs::path follow_links(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the kernel has it
  fs::path target = path;
  std::error_code failed;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(target, failed)); ++i) {
    const fs::path next = fs::read_symlink(target, failed);
    if (failed) throw cannot_write(path, failed.value());
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  if (fs::is_symlink(fs::symlink_status(target, failed))) throw cannot_write(path, ELOOP);
  return target;
}

std::string folder_of(const fs::path& path) {
  const fs::path folder = path.parent_path();
  return folder.empty() ? "." : folder.string();
}

/// A file being written under another name, beside the one that it will replace.
class TemporaryFile {
 public:
  explicit TemporaryFile(const PendingOutput& output)
      : shown_path_(output.path),
        target_(follow_links(output.path).string()),
        path_(folder_of(target_) + "/.scadray-" + unique_suffix()),
        guard_(path_.c_str()) {
    Descriptor file(open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.number() < 0) throw cannot_write(shown_path_, errno);
    exists_ = true;
    try {
      keep_permissions(file.number());
      reserve(file.number(), output.bytes.size());
      write_all(file.number(), output.bytes, shown_path_);
      if (!file.close_now()) throw cannot_write(shown_path_, errno);
    } catch (...) {
      unlink(path_.c_str());
      throw;
    }
  }
  ~TemporaryFile() {
    if (exists_) unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void put_in_place() {
    if (rename(path_.c_str(), target_.c_str()) != 0) throw cannot_write(shown_path_, errno);
    exists_ = false;
  }

 private:
  /// The file that is replaced may have been made readable to more or to fewer than a new one.
  void keep_permissions(int descriptor) const {
    struct stat old {};
    if (stat(target_.c_str(), &old) == 0 && fchmod(descriptor, old.st_mode & 0777) != 0) {
      throw cannot_write(shown_path_, errno);
    }
  }

  /// Blocks that wait to be allotted are allotted at once when their file replaces another, by ext4
  /// (its mount option auto_da_alloc), which took a quarter of a small picture's time. A wish:
  /// other file systems may refuse.
  static void reserve(int descriptor, std::size_t size) {
    if (size > 0) (void)fallocate(descriptor, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(size));
  }

  static std::string unique_suffix() {
    std::random_device random;
    return std::to_string(getpid()) + '-' + std::to_string(random()) + ".tmp";
  }

  std::string shown_path_;
  std::string target_;
  std::string path_;
  RemoveOnInterrupt guard_;
  bool exists_ = false;
};

/// True for what cannot be replaced by renaming: a device, a pipe.
bool is_special(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

void write_directly(const PendingOutput& output) {
  if (is_standard_output(output.path)) {
    write_all(STDOUT_FILENO, output.bytes, "standard output");
    return;
  }
  const Descriptor file(open(output.path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.number() < 0) throw cannot_write(output.path, errno);
  write_all(file.number(), output.bytes, output.path);
}

/// Waits until there is something to read, or the end. For what may take for ever: a pipe, a
/// terminal. Throws Stopped.
void wait_for_input(int descriptor, const StopEvent& stop) {
  std::array<pollfd, 2> waits = {pollfd{descriptor, POLLIN, 0},
                                 pollfd{stop.descriptor(), POLLIN, 0}};
  while (poll(waits.data(), waits.size(), -1) < 0 && errno == EINTR) {
  }
  if (waits[1].revents != 0) throw Stopped{};
}

}  // namespace

FileText read_descriptor(int descriptor, const std::string& name, const std::stop_token& stop) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) throw cannot_read(name, errno);
  if (S_ISDIR(status.st_mode)) {
    throw Error(name, {}, "is a folder", "give a .csg or .scad file");
  }
  std::optional<StopEvent> stop_event;
  if (stop.stop_possible() && !S_ISREG(status.st_mode)) stop_event.emplace(stop);
  Room room;
  // One byte more than the file has, so that the end shows without growing.
  const std::size_t expected =
      S_ISREG(status.st_mode) && status.st_size > 0 ? static_cast<std::size_t>(status.st_size) : 0;
  room.grow(std::max(std::min(expected, kMaxInputBytes) + 1, kFirstRoom));
  while (true) {
    throw_if_stopped(stop);
    if (room.size == room.capacity) room.grow(room.capacity * 2);
    if (stop_event) wait_for_input(descriptor, *stop_event);
    const ssize_t count = read(descriptor, room.bytes.get() + room.size, room.capacity - room.size);
    if (count < 0 && (errno == EINTR || (errno == EAGAIN && stop_event))) continue;
    if (count < 0) throw cannot_read(name, errno);
    if (count == 0) break;
    room.size += static_cast<std::size_t>(count);
    if (room.size > kMaxInputBytes) {
      throw Error(name, {}, "is larger than 4 GiB", "split the design");
    }
  }
  return FileText(std::move(room.bytes), room.size);
}

FileText read_file(const std::string& path, const std::stop_token& stop) {
  if (path == "-") return read_descriptor(STDIN_FILENO, "standard input", stop);
  // What is to be stopped must not wait for a named pipe's writer here; it does so when it reads.
  const int waits = stop.stop_possible() ? O_NONBLOCK : 0;
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | waits));
  if (file.number() < 0) throw cannot_read(path, errno);
  return read_descriptor(file.number(), path, stop);
}

void check_output(const std::string& path) {
  if (is_standard_output(path)) return;
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) throw cannot_write(path, EISDIR);
    if (access(path.c_str(), W_OK) != 0) throw cannot_write(path, errno);
    if (!S_ISREG(status.st_mode)) return;
  }
  const std::string folder = folder_of(follow_links(path));
  if (stat(folder.c_str(), &status) != 0) throw cannot_write(path, errno);
  if (!S_ISDIR(status.st_mode)) throw cannot_write(path, ENOTDIR);
  if (access(folder.c_str(), W_OK | X_OK) != 0) throw cannot_write(path, errno);
}

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

void write_outputs(std::span<const PendingOutput> outputs) {
  std::deque<TemporaryFile> files;  // its elements do not move
  for (const PendingOutput& output : outputs) {
    if (!is_standard_output(output.path) && !is_special(output.path)) files.emplace_back(output);
  }
  for (const PendingOutput& output : outputs) {
    if (is_standard_output(output.path) || is_special(output.path)) write_directly(output);
  }
  for (TemporaryFile& file : files) file.put_in_place();
}

}  // namespace frontend
