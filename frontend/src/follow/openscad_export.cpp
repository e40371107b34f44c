#include "frontend/openscad_export.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>

#include "base/descriptor.hpp"
#include "base/growing_text.hpp"
#include "follow/make_rule.hpp"
#include "follow/openscad_messages.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/parser.hpp"
#include "frontend/stop.hpp"
#include "process/child_process.hpp"
#include "process/memory_file.hpp"
#include "process/openscad_program.hpp"

namespace frontend {
namespace {

constexpr int kWait_ms = 100;  // how often `waiting` is called

/// OpenSCAD 2021.01 prints on standard output, before the .csg, the characters of a .scad that no
/// token has: backslashes outside of strings, as in MCAD's fonts.scad. Makes them blanks; returns
/// whether the text holds nothing else.
bool blank_echoes(std::span<char> text) {
  constexpr std::string_view kInNoToken = "\\@~'`";
  for (char& c : text) {
    if (kInNoToken.find(c) == std::string_view::npos) return false;
    c = ' ';
  }
  return true;
}

/// Reads what the running openscad writes and prints.
class Listener {
 public:
  Listener(const ChildProcess& openscad, const Pipe& out, const Pipe& err,
           OpenScadMessages& messages, const std::string& scad_path)
      : openscad_(openscad),
        pipes_{out.read_end(), err.read_end()},
        messages_(messages),
        scad_path_(scad_path) {}

  /// Reads until openscad has ended, or has written a start that no .csg has. The pipes are not
  /// read to their ends, since programs that openscad has started may hold them open for longer.
  /// Throws Stopped when `stop_event` becomes readable (-1: never).
  void listen(const std::function<void()>& waiting, int stop_event, const std::stop_token& stop) {
    while (!is_hopeless_) {
      if (openscad_.has_ended()) {
        drain();
        return;
      }
      std::array<pollfd, 4> waits = {pollfd{pipes_[0], POLLIN, 0}, pollfd{pipes_[1], POLLIN, 0},
                                     pollfd{openscad_.end_descriptor(), POLLIN, 0},
                                     pollfd{stop_event, POLLIN, 0}};  // poll ignores -1
      const int ready = poll(waits.data(), waits.size(), kWait_ms);
      if (ready < 0 && errno != EINTR) {
        throw std::system_error(errno, std::generic_category(), "openscad's output");
      }
      if (ready == 0) waiting();
      if (ready <= 0) continue;
      if (waits[3].revents != 0) throw Stopped{};
      for (std::size_t i = 0; i < pipes_.size(); ++i) {
        if (waits[i].revents != 0) read_from(i);
      }
      is_hopeless_ = check_.fails(csg_.view(), stop);
    }
  }
  bool is_hopeless() const { return is_hopeless_; }
  FileText take_csg() { return csg_.take(); }

 private:
  /// Reads what there is on standard output or standard error. Returns the number of bytes.
  std::size_t read_from(std::size_t pipe) {
    std::array<char, 65536> said;
    std::span<char> room = said;
    if (pipe == 0) {
      room = csg_.room();
      room = room.first(std::min(room.size(), check_.until_next(csg_.size())));
    }
    const ssize_t count = read(pipes_[pipe], room.data(), room.size());
    if (count < 0 && errno == EINTR) return 0;
    if (count <= 0) {
      pipes_[pipe] = -1;
      return 0;
    }
    const auto bytes = static_cast<std::size_t>(count);
    if (pipe == 1) {
      messages_.add({said.data(), bytes});
      return bytes;
    }
    if (is_start_) is_start_ = blank_echoes(room.first(bytes));
    csg_.add(bytes);
    if (csg_.is_too_large()) {
      throw Error(scad_path_, {}, "its .csg is larger than 4 GiB", "split the design");
    }
    return bytes;
  }

  /// Reads what is in the pipes now; more may come for ever.
  void drain() {
    for (std::size_t i = 0; i < pipes_.size(); ++i) {
      int left = 0;
      if (pipes_[i] < 0 || ioctl(pipes_[i], FIONREAD, &left) != 0) continue;
      while (left > 0 && pipes_[i] >= 0) {
        left -= static_cast<int>(read_from(i));
        is_hopeless_ = is_hopeless_ || check_.fails(csg_.view(), {});
        if (i == 0 && is_hopeless_) break;
      }
    }
  }

  const ChildProcess& openscad_;
  std::array<int, 2> pipes_;  // standard output and standard error; -1: at its end
  OpenScadMessages& messages_;
  const std::string& scad_path_;
  GrowingText csg_{0};
  bool is_start_ = true;  // nothing of the .csg was read yet
  StartCheck check_{is_beyond_repair, 0};
  bool is_hopeless_ = false;
};

}  // namespace

OpenScadExport export_with_openscad(const std::string& scad_path,
                                    const std::vector<std::string>& arguments,
                                    const DesignMessageSink& message,
                                    const std::function<void()>& waiting,
                                    const std::stop_token& stop,
                                    const std::optional<FileText>& text) {
  std::optional<StopEvent> stop_event;
  if (stop.stop_possible()) stop_event.emplace(stop);
  const int stop_descriptor = stop_event ? stop_event->descriptor() : -1;
  throw_if_stopped(stop);
  const MemoryFile rule;
  std::vector<std::string> command = {openscad_program(),    "-o", "-",
                                      "--export-format=csg", "-d", rule.path()};
  const std::vector<std::string> known =
      known_to_openscad(arguments, [&](const std::string& line) { message({line}); });
  command.insert(command.end(), known.begin(), known.end());
  command.push_back("--");  // a name may begin with a dash
  std::optional<MemoryFile> input;
  if (text) input.emplace(text->view());
  command.push_back(text ? "-" : scad_path);

  Pipe out, err;
  ChildProcess openscad =
      start_openscad({.command = command,
                      .output = out.write_end(),
                      .errors = err.write_end(),
                      .kept = rule.descriptor(),
                      .input = input ? input->descriptor() : -1},
                     "a .scad file is exported by OpenSCAD", "; or give a .csg file");
  out.close_write_end();
  err.close_write_end();
  OpenScadMessages messages(message);
  Listener listener(openscad, out, err, messages, scad_path);
  listener.listen(waiting, stop_descriptor, stop);
  throw_if_stopped(stop);
  messages.finish();
  OpenScadExport result;
  result.csg = listener.take_csg();

  if (listener.is_hopeless()) {
    if (messages.first_error()) throw openscad_error(scad_path, *messages.first_error());
    return result;  // the parser will say what is wrong
  }
  const int exit_code = openscad.wait();
  if (messages.first_error()) throw openscad_error(scad_path, *messages.first_error());
  if (exit_code != 0) {
    throw Error(scad_path, {}, "openscad failed with exit code " + std::to_string(exit_code),
                "see what it says above");
  }
  if (result.csg.view().empty()) {
    throw Error(scad_path, {}, "openscad wrote no .csg", "see what it says above");
  }
  result.files = prerequisites_of(read_descriptor(rule.descriptor(), "a file in memory").view());
  return result;
}

}  // namespace frontend
