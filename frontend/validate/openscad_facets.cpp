#include "openscad_facets.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <span>
#include <system_error>
#include <utility>

#include "base/growing_text.hpp"
#include "meshes/read_solid_file.hpp"
#include "process/child_process.hpp"
#include "process/memory_file.hpp"
#include "process/openscad_program.hpp"

namespace validation {
namespace {

using Clock = std::chrono::steady_clock;

/// The most bytes that openscad may write: a mesh of two million facets.
constexpr std::size_t kMostOutput = std::size_t{1} << 30;
/// The most bytes of its messages that are looked at.
constexpr std::size_t kMostMessages = std::size_t{1} << 16;
/// How often the child's end is looked for where the system cannot tell of it.
constexpr std::chrono::milliseconds kLook{100};

/// Reads what the running openscad writes and says.
class Listener {
 public:
  Listener(const frontend::ChildProcess& openscad, const frontend::Pipe& out,
           const frontend::Pipe& err)
      : openscad_(openscad), pipes_{out.read_end(), err.read_end()} {}

  /// Reads until openscad has ended and has nothing more to say. Returns false at the deadline, or
  /// if openscad writes too much.
  bool listen(Clock::time_point deadline) {
    for (;;) {
      const bool has_ended = openscad_.has_ended();
      const auto rest = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
      if (rest.count() <= 0 || is_too_large()) return false;
      std::array<pollfd, 3> waits = {
          pollfd{pipes_[0], POLLIN, 0}, pollfd{pipes_[1], POLLIN, 0},
          pollfd{has_ended ? -1 : openscad_.end_descriptor(), POLLIN, 0}};  // poll ignores -1
      const auto wait = has_ended ? std::chrono::milliseconds(0) : std::min(rest, kLook);
      const int ready = poll(waits.data(), waits.size(), static_cast<int>(wait.count()));
      if (ready < 0 && errno != EINTR) {
        throw std::system_error(errno, std::generic_category(), "openscad's output");
      }
      if (ready == 0 && has_ended) return true;
      if (ready <= 0) continue;
      for (std::size_t i = 0; i < pipes_.size(); ++i) {
        if (waits[i].revents != 0) read_from(i);
      }
    }
  }

  bool is_too_large() const { return output_.size() > kMostOutput; }
  std::string_view output() const { return output_.view(); }
  const std::string& messages() const { return messages_; }

 private:
  void read_from(std::size_t pipe) {
    std::array<char, 4096> said;
    const std::span<char> room = pipe == 0 ? output_.room() : std::span<char>(said);
    const ssize_t count = read(pipes_[pipe], room.data(), room.size());
    if (count < 0 && errno == EINTR) return;
    if (count <= 0) {
      pipes_[pipe] = -1;
    } else if (pipe == 0) {
      output_.add(static_cast<std::size_t>(count));
    } else if (messages_.size() < kMostMessages) {
      messages_.append(room.data(), static_cast<std::size_t>(count));
    }
  }

  const frontend::ChildProcess& openscad_;
  std::array<int, 2> pipes_;  // standard output and standard error; -1: at its end
  frontend::GrowingText output_{0};
  std::string messages_;
};

/// Returns what the first error among openscad's messages says; empty if there is none.
std::string first_error(std::string_view messages) {
  constexpr std::string_view kError = "ERROR: ";
  const std::size_t start = messages.find(kError);
  if (start == std::string_view::npos) return {};
  const std::string_view line = messages.substr(start, messages.find('\n', start) - start);
  return std::string(line.substr(kError.size()));
}

OpenScadFacets result_of(std::string_view output, std::string_view messages, int exit_code) {
  constexpr std::string_view kEmpty = "Current top level object is empty";
  const std::string error = first_error(messages);
  if (exit_code == 0) {
    frontend::SolidFile file = frontend::read_off(output, "openscad's output");
    if (file.problem.empty()) return {std::move(file.faces), {}};
  } else if (error.empty() && messages.find(kEmpty) != std::string_view::npos) {
    return {frontend::FaceSet{}, {}};
  }
  if (!error.empty()) return {std::nullopt, "openscad says: " + error};
  return {std::nullopt, exit_code == 0
                            ? "openscad wrote no solid"
                            : "openscad failed with exit code " + std::to_string(exit_code)};
}

std::string cannot_run(const std::string& program, int error_number) {
  if (error_number == ENOENT) return program + " was not found: apt-get install openscad";
  return program + " cannot be run: " + std::strerror(error_number);
}

}  // namespace

OpenScadFacets facets_by_openscad(std::string_view design, Clock::time_point deadline) {
  const frontend::MemoryFile input(design);
  frontend::Pipe out, err;
  std::optional<frontend::ChildProcess> openscad;
  const frontend::ChildSetup setup{
      {frontend::openscad_program(), "-o", "-", "--export-format=off", "--", input.path()},
      out.write_end(),
      err.write_end(),
      input.descriptor()};
  try {
    openscad.emplace(setup);
  } catch (const std::system_error& error) {
    return {std::nullopt, cannot_run(setup.command[0], error.code().value())};
  }
  out.close_write_end();
  err.close_write_end();
  Listener listener(*openscad, out, err);
  if (!listener.listen(deadline)) {
    return {std::nullopt, listener.is_too_large() ? "openscad writes more than 1 GiB"
                                                  : "openscad has not finished in time"};
  }
  return result_of(listener.output(), listener.messages(), openscad->wait());
}

}  // namespace validation
