#include "frontend/openscad_export.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "descriptor.hpp"
#include "frontend/error.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/stop.hpp"
#include "make_rule.hpp"

extern char** environ;

namespace frontend {
namespace {

constexpr int kWait_ms = 100;  // how often `waiting` is called

std::string program_name() {
  const char* name = std::getenv("OPENSCAD");
  return name && *name ? name : "openscad";
}

Error cannot_run(const std::string& program, int error_number) {
  if (error_number == ENOENT) {
    return Error("", {}, "a .scad file is exported by OpenSCAD, and " + program + " was not found",
                 "install it, with: apt-get install openscad; or name it in $OPENSCAD; or give a "
                 ".csg file");
  }
  return Error("", {}, program + " cannot be run: " + std::strerror(error_number),
               "check $OPENSCAD and PATH");
}

/// A pipe whose ends are closed with it, unless closed before.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) throw cannot_run("a pipe", errno);
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_write_end() { close_end(1); }

 private:
  void close_end(std::size_t end) {
    if (ends_[end] >= 0) close(ends_[end]);
    ends_[end] = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

/// A file without a name, in memory.
class MemoryFile {
 public:
  MemoryFile() : file_(memfd_create("scadray", MFD_CLOEXEC)) {
    if (file_ < 0) throw cannot_run("a file in memory", errno);
  }
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  int descriptor() const { return file_; }
  /// For a child that it is handed on to.
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }
  /// Once.
  FileText text() const { return read_descriptor(file_, "a file in memory"); }

 private:
  int file_;
};

/// A running program in a process group of its own, killed if it is not waited for.
class Child {
 public:
  /// `kept`: a file that the program gets, too; null: none.
  Child(const std::vector<std::string>& command, const Pipe& out, const Pipe& err,
        const MemoryFile* kept);
  ~Child() {
    if (pid_ <= 0) return;
    kill(-pid_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Returns when it has ended, or `stop` is to be read from. Without one (-1) wait() does.
  void wait_for_end(int stop) const {
    if (stop < 0) return;
    // glibc 2.36 declares pidfd_open() for C only.
    const Descriptor child(static_cast<int>(syscall(SYS_pidfd_open, pid_, 0)));
    if (child.number() < 0) return;  // a kernel before 5.3
    std::array<pollfd, 2> waits = {pollfd{child.number(), POLLIN, 0}, pollfd{stop, POLLIN, 0}};
    while (poll(waits.data(), waits.size(), -1) < 0 && errno == EINTR) {
    }
  }

  /// The exit code; 128 and the signal's number where one ended it.
  int wait() {
    siginfo_t info{};
    while (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    set_child_group(0);  // while the number cannot be another's yet
    int status = 0;
    waitpid(std::exchange(pid_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t pid_ = 0;
};

Child::Child(const std::vector<std::string>& command, const Pipe& out, const Pipe& err,
             const MemoryFile* kept) {
  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));  // execve's signature; not written to
  }
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, out.write_end(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, err.write_end(), STDERR_FILENO);
  // Onto itself: it stays open.
  if (kept) posix_spawn_file_actions_adddup2(&files, kept->descriptor(), kept->descriptor());

  // An interruption must find the child's group registered once it runs, so none may come between.
  sigset_t all, before, defaults;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  sigemptyset(&defaults);
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    sigaddset(&defaults, signal_number);
  }
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setsigmask(&attributes, &before);

  set_child_group(kStartingChild);
  const int failed =
      posix_spawnp(&pid_, arguments[0], &files, &attributes, arguments.data(), environ);
  set_child_group(failed == 0 ? pid_ : 0);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) {
    pid_ = 0;
    throw cannot_run(command[0], failed);
  }
}

/// What openscad says, line by line. The first ERROR is kept back, to be thrown.
class Messages {
 public:
  explicit Messages(const std::function<void(const std::string&)>& message) : message_(message) {}
  void add(std::string_view text) {
    pending_ += text;
    std::size_t start = 0;
    for (std::size_t end; (end = pending_.find('\n', start)) != std::string::npos;
         start = end + 1) {
      line(pending_.substr(start, end - start));
    }
    pending_.erase(0, start);
  }
  void finish() {
    if (!pending_.empty()) line(pending_);
    pending_.clear();
  }
  const std::optional<std::string>& first_error() const { return first_error_; }

 private:
  void line(const std::string& text) {
    if (text.empty()) return;
    if (text.starts_with("ERROR: ") && !first_error_) {
      first_error_ = text.substr(std::strlen("ERROR: "));
    } else {
      message_(text);
    }
  }
  const std::function<void(const std::string&)>& message_;
  std::string pending_;
  std::optional<std::string> first_error_;
};

/// Whether openscad means `scad_path` by `name`: it shortens a path to the file's name alone, or
/// makes it relative to the working folder.
bool is_same_file(const std::string& name, const std::string& scad_path) {
  const std::filesystem::path path(scad_path);
  std::error_code missing;
  return name == path.filename() || std::filesystem::equivalent(name, path, missing);
}

/// "what in file NAME, line N" → Error with that place.
Error openscad_error(const std::string& scad_path, const std::string& text) {
  constexpr const char* kTodo = "correct the design; this is what openscad reports";
  constexpr std::string_view kFile = " in file ", kLine = ", line ";
  const std::size_t file_at = text.rfind(kFile);
  const std::size_t line_at = text.rfind(kLine);
  if (file_at == std::string::npos || line_at == std::string::npos || line_at < file_at) {
    return Error(scad_path, {}, text, kTodo);
  }
  std::string file = text.substr(file_at + kFile.size(), line_at - file_at - kFile.size());
  if (is_same_file(file, scad_path)) file = scad_path;
  Location location;
  const char* digits = text.data() + line_at + kLine.size();
  std::from_chars(digits, text.data() + text.size(), location.line);
  return Error(file, location, text.substr(0, file_at), kTodo);
}

/// Reads both pipes to their ends, so that neither fills up while we wait for the other. Throws
/// Stopped when `stop` is to be read from (-1: never).
std::string read_both(const Pipe& out, const Pipe& err, const std::string& scad_path,
                      Messages& messages, const std::function<void()>& waiting, int stop) {
  std::string csg;
  std::array<pollfd, 3> waits = {pollfd{out.read_end(), POLLIN, 0},
                                 pollfd{err.read_end(), POLLIN, 0},
                                 pollfd{stop, POLLIN, 0}};  // poll passes over -1
  std::array<char, 65536> buffer;
  while (waits[0].fd >= 0 || waits[1].fd >= 0) {
    const int ready = poll(waits.data(), waits.size(), kWait_ms);
    if (ready < 0 && errno != EINTR) throw cannot_run("openscad's output", errno);
    if (ready <= 0) {
      waiting();
      continue;
    }
    if (waits[2].revents != 0) throw Stopped{};
    for (std::size_t i = 0; i < 2; ++i) {
      if (waits[i].fd < 0 || waits[i].revents == 0) continue;
      const ssize_t count = read(waits[i].fd, buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        waits[i].fd = -1;
      } else if (i == 0) {
        csg.append(buffer.data(), static_cast<std::size_t>(count));
      } else {
        messages.add({buffer.data(), static_cast<std::size_t>(count)});
      }
    }
    if (csg.size() > kMaxInputBytes) {
      throw Error(scad_path, {}, "its .csg is larger than 4 GiB", "split the design");
    }
  }
  return csg;
}

}  // namespace

OpenScadExport export_with_openscad(const std::string& scad_path,
                                    const std::vector<std::string>& arguments, bool wants_files,
                                    const std::function<void(const std::string&)>& message,
                                    const std::function<void()>& waiting,
                                    const std::stop_token& stop) {
  std::optional<StopEvent> stop_event;
  if (stop.stop_possible()) stop_event.emplace(stop);
  const int stop_descriptor = stop_event ? stop_event->descriptor() : -1;
  throw_if_stopped(stop);
  std::vector<std::string> command = {program_name(), "-o", "-", "--export-format=csg"};
  std::optional<MemoryFile> rule;
  if (wants_files) {
    rule.emplace();
    command.insert(command.end(), {"-d", rule->path()});
  }
  command.insert(command.end(), arguments.begin(), arguments.end());
  command.push_back("--");  // a name may begin with a dash
  command.push_back(scad_path);

  Pipe out, err;
  Child child(command, out, err, rule ? &*rule : nullptr);
  out.close_write_end();
  err.close_write_end();
  Messages messages(message);
  const std::string csg = read_both(out, err, scad_path, messages, waiting, stop_descriptor);
  child.wait_for_end(stop_descriptor);
  throw_if_stopped(stop);
  messages.finish();
  const int exit_code = child.wait();

  if (messages.first_error()) throw openscad_error(scad_path, *messages.first_error());
  if (exit_code != 0) {
    throw Error(scad_path, {}, "openscad failed with exit code " + std::to_string(exit_code),
                "see what it says above");
  }
  if (csg.empty()) {
    throw Error(scad_path, {}, "openscad wrote no .csg", "see what it says above");
  }
  OpenScadExport result;
  if (rule) result.files = prerequisites_of(rule->text().view());
  auto bytes = std::make_unique_for_overwrite<char[]>(csg.size());
  std::memcpy(bytes.get(), csg.data(), csg.size());
  result.csg = FileText(std::move(bytes), csg.size());
  return result;
}

}  // namespace frontend
