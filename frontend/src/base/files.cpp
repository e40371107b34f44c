#include "frontend/files.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>

#include "base/descriptor.hpp"
#include "base/growing_text.hpp"
#include "frontend/error.hpp"
#include "frontend/stop.hpp"

namespace frontend {
namespace {

Error cannot_read(const std::string& name, int error_number) {
  return Error(name, {}, std::string("cannot be read: ") + std::strerror(error_number),
               error_number == ENOENT ? "check the file's name" : "check the file");
}

/// Waits until there is something to read, or the end, on a descriptor that may take for ever: a
/// pipe or a terminal. Throws Stopped.
void wait_for_input(int descriptor, const StopEvent& stop) {
  std::array<pollfd, 2> waits = {pollfd{descriptor, POLLIN, 0},
                                 pollfd{stop.descriptor(), POLLIN, 0}};
  while (poll(waits.data(), waits.size(), -1) < 0 && errno == EINTR) {
  }
  if (waits[1].revents != 0) throw Stopped{};
}

Descriptor open_to_read(const std::string& path, const std::stop_token& stop) {
  // A read that can be stopped must not wait for a named pipe's writer here; it waits when it
  // reads.
  const int waits = stop.stop_possible() ? O_NONBLOCK : 0;
  const int number = open(path.c_str(), O_RDONLY | O_CLOEXEC | waits);
  if (number < 0) throw cannot_read(path, errno);
  return Descriptor(number);
}

/// Throws Error if the descriptor is a folder.
struct stat status_of(int descriptor, const std::string& name) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) throw cannot_read(name, errno);
  if (S_ISDIR(status.st_mode)) {
    throw Error(name, {}, "is a folder", "give a .csg or .scad file");
  }
  return status;
}

}  // namespace

std::string input_name(const std::string& path) { return path == "-" ? "standard input" : path; }

bool is_read_once(const std::string& path) {
  if (path == "-") return true;
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

FileText read_descriptor(int descriptor, const std::string& name, const IsHopeless& is_hopeless,
                         const std::stop_token& stop, std::size_t most_if_hopeless) {
  const struct stat status = status_of(descriptor, name);
  std::optional<StopEvent> stop_event;
  if (stop.stop_possible() && !S_ISREG(status.st_mode)) stop_event.emplace(stop);
  const std::size_t expected =
      S_ISREG(status.st_mode) && status.st_size > 0 ? static_cast<std::size_t>(status.st_size) : 0;
  GrowingText text(expected);
  std::optional<StartCheck> check;
  if (is_hopeless) check.emplace(is_hopeless, expected);
  bool has_failed = false;
  while (true) {
    throw_if_stopped(stop);
    if (check && check->fails(text.view(), stop)) {
      has_failed = true;
      check.reset();
    }
    if (has_failed && text.size() >= most_if_hopeless) break;
    if (stop_event) wait_for_input(descriptor, *stop_event);
    std::span<char> room = text.room();
    if (check) room = room.first(std::min(room.size(), check->until_next(text.size())));
    const ssize_t count = read(descriptor, room.data(), room.size());
    if (count < 0 && (errno == EINTR || (errno == EAGAIN && stop_event))) continue;
    if (count < 0) throw cannot_read(name, errno);
    if (count == 0) break;
    text.add(static_cast<std::size_t>(count));
    if (text.is_too_large()) throw Error(name, {}, "is larger than 4 GiB", "split the design");
  }
  return text.take();
}

FileText read_file(const std::string& path, const IsHopeless& is_hopeless,
                   const std::stop_token& stop, std::size_t most_if_hopeless) {
  const Descriptor file = path == "-" ? Descriptor(-1) : open_to_read(path, stop);
  return read_descriptor(path == "-" ? STDIN_FILENO : file.number(), input_name(path), is_hopeless,
                         stop, most_if_hopeless);
}

FileText read_regular_file(const std::string& path) {
  // A named pipe without a writer would be waited for.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0) throw cannot_read(path, errno);
  if (!S_ISREG(status_of(file.number(), path).st_mode)) {
    throw Error(path, {}, "is no regular file", "check the file");
  }
  return read_descriptor(file.number(), path);
}

void check_input(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) throw cannot_read(path, errno);
  if (S_ISFIFO(status.st_mode)) return;  // opening a pipe would tell its writer that somebody reads
  if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) {
    throw Error(path, {}, "is a device", "give a .csg or .scad file");
  }
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0) throw cannot_read(path, errno);
  status_of(file.number(), path);
}

}  // namespace frontend
