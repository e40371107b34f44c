// Checks where outputs may go, and writes all of them or none.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <tuple>
#include <utility>

#include "base/descriptor.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/terminal.hpp"

namespace frontend {
namespace {

namespace fs = std::filesystem;

Error cannot_write(const std::string& path, int error_number) {
  return Error(path, {}, std::string("cannot be written: ") + std::strerror(error_number),
               error_number == EFBIG ? "raise the limit on a file's size: ulimit -f"
                                     : "check the folder, its permissions and the space left");
}

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

/// Returns where a chain of links ends, which need not exist.
fs::path follow_links(const std::string& path) {
  constexpr int kMostLinks = 40;  // as in the kernel
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

/// Makes room on the disk, so that most failures come before anything is written. It also saves
/// time: when a file replaces another, ext4 (its mount option auto_da_alloc) at once allots blocks
/// that still wait to be allotted, which took a quarter of a small picture's time. File systems may
/// refuse. Returns false, with errno set, on failure.
bool reserve(int descriptor, std::size_t size) {
  return size == 0 || fallocate(descriptor, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(size)) == 0;
}

/// Thrown if a folder takes no other file: it is read-only, or not ours.
struct FolderRefuses {
  int error_number;
};

/// A file that is written under another name, beside the one that it will replace.
class TemporaryFile {
 public:
  /// Throws FolderRefuses or Error. `output` must outlive this object.
  explicit TemporaryFile(const PendingOutput& output)
      : output_(output),
        target_(follow_links(output.path).string()),
        path_(folder_of(target_) + "/.scadray-" + unique_suffix()),
        guard_(path_.c_str()) {
    Descriptor file(open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.number() < 0) {
      if (errno == EACCES || errno == EPERM || errno == EROFS) throw FolderRefuses{errno};
      throw cannot_write(output.path, errno);
    }
    exists_ = true;
    try {
      keep_permissions(file.number());
      reserve(file.number(), output.bytes.size());
      write_all(file.number(), output.bytes, output.path);
      if (!file.close_now()) throw cannot_write(output.path, errno);
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

  const PendingOutput& output() const { return output_; }
  /// Throws FolderRefuses or Error.
  void put_in_place() {
    if (rename(path_.c_str(), target_.c_str()) != 0) {
      // EPERM: somebody else's file in a folder like /tmp. EBUSY: a file that is a mount point.
      if (errno == EACCES || errno == EPERM || errno == EBUSY) throw FolderRefuses{errno};
      throw cannot_write(output_.path, errno);
    }
    exists_ = false;
  }

 private:
  /// Gives the new file the permissions of the file that it replaces.
  void keep_permissions(int descriptor) const {
    struct stat old {};
    if (stat(target_.c_str(), &old) == 0 && fchmod(descriptor, old.st_mode & 0777) != 0) {
      throw cannot_write(output_.path, errno);
    }
  }

  static std::string unique_suffix() {
    std::random_device random;
    return std::to_string(getpid()) + '-' + std::to_string(random()) + ".tmp";
  }

  const PendingOutput& output_;
  std::string target_;
  std::string path_;
  RemoveOnInterrupt guard_;
  bool exists_ = false;
};

/// A file that is overwritten, since no other can be put in its place.
class FileInPlace {
 public:
  /// Writes nothing yet. Throws Error, with the reason of `refusal` if there is no such file.
  /// `output` must outlive this object.
  FileInPlace(const PendingOutput& output, const FolderRefuses& refusal)
      : output_(output), file_(open(output.path.c_str(), O_RDWR | O_CLOEXEC)) {
    if (file_.number() < 0) {
      throw cannot_write(output.path, errno == ENOENT ? refusal.error_number : errno);
    }
    old_ = read_descriptor(file_.number(), output.path);
    if (!reserve(file_.number(), output.bytes.size()) && (errno == ENOSPC || errno == EDQUOT)) {
      throw cannot_write(output.path, errno);
    }
  }
  /// Restores the old contents, unless the new ones were kept.
  ~FileInPlace() {
    if (!is_touched_) return;
    const HoldInterrupts hold;
    try {
      replace_by(std::as_bytes(std::span(old_.view())));
    } catch (const Error&) {  // nothing more can be done
    }
  }
  FileInPlace(const FileInPlace&) = delete;
  FileInPlace& operator=(const FileInPlace&) = delete;

  void write() {
    is_touched_ = true;
    replace_by(output_.bytes);
  }
  void keep() { is_touched_ = false; }

 private:
  void replace_by(std::span<const std::byte> bytes) {
    if (lseek(file_.number(), 0, SEEK_SET) != 0) throw cannot_write(output_.path, errno);
    write_all(file_.number(), bytes, output_.path);
    if (ftruncate(file_.number(), static_cast<off_t>(bytes.size())) != 0) {
      throw cannot_write(output_.path, errno);
    }
  }

  const PendingOutput& output_;
  Descriptor file_;
  FileText old_;
  bool is_touched_ = false;
};

/// Returns whether the path is a device or a pipe, which renaming cannot replace.
bool is_special(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

/// Writes what a device or a pipe gets: a terminal gets nothing that steers it.
void write_to_special(int descriptor, const PendingOutput& output, const std::string& name) {
  if (isatty(descriptor) != 1) return write_all(descriptor, output.bytes, name);
  const auto* text = reinterpret_cast<const char*>(output.bytes.data());
  const std::string shown = visible({text, output.bytes.size()});
  write_all(descriptor, std::as_bytes(std::span(shown)), name);
}

void write_directly(const PendingOutput& output) {
  if (is_standard_output(output.path))
    return write_to_special(STDOUT_FILENO, output, "standard output");
  const Descriptor file(open(output.path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.number() < 0) throw cannot_write(output.path, errno);
  write_to_special(file.number(), output, output.path);
}

/// A file's device and inode, with an empty name; or, if it does not exist, those of its folder,
/// and its name there.
using FileIdentity = std::tuple<dev_t, ino_t, std::string>;

/// Returns nothing if the file is not regular, or could not be made a regular one. `standard` is
/// the descriptor that "-" stands for.
std::optional<FileIdentity> identity_of(const std::string& path, int standard) {
  struct stat status {};
  const bool is_standard = path == "-" || (standard == STDOUT_FILENO && is_standard_output(path));
  const int failed = is_standard ? fstat(standard, &status) : stat(path.c_str(), &status);
  if (failed == 0) {
    if (!S_ISREG(status.st_mode)) return std::nullopt;
    return FileIdentity{status.st_dev, status.st_ino, ""};
  }
  if (is_standard || errno != ENOENT) return std::nullopt;
  const fs::path target = follow_links(path);
  if (stat(folder_of(target).c_str(), &status) != 0) return std::nullopt;
  return FileIdentity{status.st_dev, status.st_ino, target.filename().string()};
}

}  // namespace

void check_output(const std::string& path) {
  if (is_standard_output(path)) return;
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) throw cannot_write(path, EISDIR);
    if (access(path.c_str(), W_OK) != 0) throw cannot_write(path, errno);
    if (!S_ISREG(status.st_mode)) return;
    if (access(path.c_str(), R_OK | W_OK) == 0) return;  // can be overwritten in place
  }
  const std::string folder = folder_of(follow_links(path));
  if (stat(folder.c_str(), &status) != 0) throw cannot_write(path, errno);
  if (!S_ISDIR(status.st_mode)) throw cannot_write(path, ENOTDIR);
  if (access(folder.c_str(), W_OK | X_OK) != 0) throw cannot_write(path, errno);
}

void check_outputs_differ(std::span<const NamedPath> outputs, std::span<const NamedPath> inputs) {
  std::map<FileIdentity, const NamedPath*> known;
  for (const NamedPath& input : inputs) {
    if (const auto file = identity_of(input.path, STDIN_FILENO)) known.emplace(*file, &input);
  }
  for (const NamedPath& output : outputs) {
    const auto file = identity_of(output.path, STDOUT_FILENO);
    if (!file) continue;
    const auto [other, is_new] = known.emplace(*file, &output);
    if (is_new) continue;
    const NamedPath& first = *other->second;
    throw Error(output.path, {},
                output.role + " would overwrite " + first.role +
                    (first.path == output.path ? "" : ", which is " + first.path),
                "give " + output.role + " a file of its own");
  }
}

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

void write_outputs(std::span<const PendingOutput> outputs) {
  const auto goes_directly = [](const PendingOutput& output) {
    return is_standard_output(output.path) || is_special(output.path);
  };
  std::deque<TemporaryFile> files;  // a deque does not move its elements
  std::deque<FileInPlace> in_place;
  for (const PendingOutput& output : outputs) {
    if (goes_directly(output)) continue;
    try {
      files.emplace_back(output);
    } catch (const FolderRefuses& refusal) {
      in_place.emplace_back(output, refusal);
    }
  }
  for (const PendingOutput& output : outputs) {
    if (goes_directly(output)) write_directly(output);
  }
  const HoldInterrupts hold;  // all files are put in place, or none
  for (FileInPlace& file : in_place) file.write();
  for (TemporaryFile& file : files) {
    try {
      file.put_in_place();
    } catch (const FolderRefuses& refusal) {
      in_place.emplace_back(file.output(), refusal).write();
    }
  }
  for (FileInPlace& file : in_place) file.keep();
}

}  // namespace frontend
