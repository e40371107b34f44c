#include "rendered/rendering.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <map>
#include <mutex>
#include <span>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "base/elapsed.hpp"
#include "base/growing_text.hpp"
#include "frontend/stop.hpp"
#include "meshes/read_solid_file.hpp"
#include "process/child_process.hpp"
#include "process/memory_file.hpp"
#include "process/openscad_program.hpp"
#include "rendered/render_cache.hpp"

namespace frontend {
namespace {

/// The most bytes that openscad may write: a mesh of two million facets.
constexpr std::size_t kMostOutput = std::size_t{1} << 30;
/// The most bytes of its messages that are looked at.
constexpr std::size_t kMostMessages = std::size_t{1} << 16;
/// How often the child's end is looked for where the system cannot tell of it.
constexpr std::chrono::milliseconds kLook{100};

/// Reads what the running openscad writes and says.
class Listener {
 public:
  Listener(const ChildProcess& openscad, const Pipe& out, const Pipe& err)
      : openscad_(openscad), pipes_{out.read_end(), err.read_end()} {}

  /// Reads until openscad has ended and has nothing more to say. Returns false at the deadline, or
  /// if openscad writes too much. Throws Stopped.
  bool listen(Clock::time_point deadline, const std::stop_token& stop) {
    const StopEvent stopped(stop);
    for (;;) {
      const bool has_ended = openscad_.has_ended();
      const auto rest = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
      if (rest.count() <= 0 || is_too_large()) return false;
      std::array<pollfd, 4> waits = {
          pollfd{pipes_[0], POLLIN, 0}, pollfd{pipes_[1], POLLIN, 0},
          pollfd{has_ended ? -1 : openscad_.end_descriptor(), POLLIN, 0},  // poll ignores -1
          pollfd{stopped.descriptor(), POLLIN, 0}};
      const auto wait = has_ended ? std::chrono::milliseconds(0) : std::min(rest, kLook);
      const int ready = poll(waits.data(), waits.size(), static_cast<int>(wait.count()));
      if (ready < 0 && errno != EINTR) {
        throw std::system_error(errno, std::generic_category(), "openscad's output");
      }
      throw_if_stopped(stop);
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

  const ChildProcess& openscad_;
  std::array<int, 2> pipes_;  // standard output and standard error; -1: at its end
  GrowingText output_{0};
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

std::optional<RingedFaces> faces_of(std::string_view output, OpenScadFormat format) {
  if (format == OpenScadFormat::kNef3) return read_nef_text(output);
  SolidFile file = read_off(output, "openscad's output");
  if (!file.problem.empty()) return std::nullopt;
  RingedFaces faces;
  for (size_t i = 0; i < file.faces.face_count(); ++i) {
    const std::span<const uint32_t> face = file.faces.face(i);
    faces.corners.insert(faces.corners.end(), face.begin(), face.end());
    faces.end_ring();
    faces.end_face();
  }
  faces.points = std::move(file.faces.points);
  return faces;
}

OpenScadResult result_of(std::string_view output, OpenScadFormat format, std::string_view messages,
                         int exit_code) {
  constexpr std::string_view kEmpty = "Current top level object is empty";
  const std::string error = first_error(messages);
  if (exit_code == 0) {
    if (std::optional<RingedFaces> faces = faces_of(output, format)) return {std::move(faces), {}};
  } else if (error.empty() && messages.find(kEmpty) != std::string_view::npos) {
    return {RingedFaces{}, {}};
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

/// More of them would only compete for memory.
constexpr std::size_t kMostProcesses = 16;
constexpr std::chrono::milliseconds kProgressInterval{100};
/// A longer time limit means none: some years, which the clock can still add.
constexpr double kLongest_s = 1e8;

/// The requests that differ, and which of them each request is.
struct DifferentRequests {
  std::vector<const RenderRequest*> all;
  std::vector<std::size_t> index_of;  // by request

  explicit DifferentRequests(std::span<const RenderRequest> requests) {
    std::map<std::pair<std::string_view, std::string_view>, std::size_t> known;
    for (const RenderRequest& request : requests) {
      const auto [entry, is_new] = known.try_emplace({request.text, request.inputs}, all.size());
      if (is_new) all.push_back(&request);
      index_of.push_back(entry->second);
    }
  }
};

/// Renders what is missing, by several threads, each of which waits for one openscad at a time.
class RenderThreads {
 public:
  RenderThreads(std::span<const RenderRequest* const> requests, std::span<Rendering> renderings,
                const RenderCache& cache, std::string identity, Clock::time_point deadline)
      : requests_(requests),
        renderings_(renderings),
        cache_(cache),
        identity_(std::move(identity)),
        deadline_(deadline) {}

  std::string key_of(const RenderRequest& request) const {
    return identity_ + '\n' + request.inputs + '\n' + request.text;
  }

  void run(std::vector<std::size_t> missing, const RenderingOptions& options,
           const std::stop_token& stop) {
    missing_ = std::move(missing);
    is_finished_.assign(missing_.size(), false);
    const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> threads(std::min({missing_.size(), processors, kMostProcesses}));
    const bool is_in_background = options.is_in_background;
    for (std::jthread& thread : threads) {
      thread = std::jthread([&stop, is_in_background, this] { work(is_in_background, stop); });
    }
    std::unique_lock lock(mutex_);
    while (
        !changed_.wait_for(lock, kProgressInterval, [&] { return finished_ == missing_.size(); })) {
      if (!options.progress) continue;
      const auto first = std::ranges::find(is_finished_, false) - is_finished_.begin();
      const RenderingProgress progress{requests_[missing_[static_cast<std::size_t>(first)]]->line,
                                       finished_, missing_.size()};
      lock.unlock();
      options.progress(progress);
      lock.lock();
    }
  }

 private:
  void work(bool is_in_background, const std::stop_token& stop) {
    for (std::size_t i; (i = next_++) < missing_.size();) {
      Rendering rendering = render(*requests_[missing_[i]], is_in_background, stop);
      const std::lock_guard lock(mutex_);
      renderings_[missing_[i]] = std::move(rendering);
      is_finished_[i] = true;
      ++finished_;
      changed_.notify_one();
    }
  }

  /// Returns nothing if it is stopped.
  Rendering render(const RenderRequest& request, bool is_in_background,
                   const std::stop_token& stop) const {
    try {
      OpenScadResult result = evaluate_by_openscad(request.text, OpenScadFormat::kNef3,
                                                   is_in_background, deadline_, stop);
      if (!result.faces) return {nullptr, std::move(result.problem)};
      cache_.keep(key_of(request), *result.faces);
      return {std::make_shared<const RingedFaces>(std::move(*result.faces)), {}};
    } catch (const Stopped&) {
      return {};
    } catch (const std::exception& error) {
      return {nullptr, error.what()};
    }
  }

  const std::span<const RenderRequest* const> requests_;
  const std::span<Rendering> renderings_;
  const RenderCache& cache_;
  const std::string identity_;
  const Clock::time_point deadline_;

  std::vector<std::size_t> missing_;  // of the requests
  std::atomic<std::size_t> next_{0};  // of `missing_`
  std::mutex mutex_;                  // for all below, and for `renderings_`
  std::condition_variable changed_;
  std::vector<bool> is_finished_;  // by `missing_`
  std::size_t finished_ = 0;
};

}  // namespace

OpenScadResult evaluate_by_openscad(std::string_view design, OpenScadFormat format,
                                    bool is_in_background, Clock::time_point deadline,
                                    const std::stop_token& stop) {
  throw_if_stopped(stop);  // before another one is started
  const MemoryFile input(design);
  Pipe out, err;
  std::optional<ChildProcess> openscad;
  const ChildSetup setup{
      {openscad_program(), "-o", "-",
       format == OpenScadFormat::kNef3 ? "--export-format=nef3" : "--export-format=off", "--",
       input.path()},
      out.write_end(),
      err.write_end(),
      input.descriptor(),
      is_in_background};
  try {
    openscad.emplace(setup);
  } catch (const std::system_error& error) {
    return {std::nullopt, cannot_run(setup.command[0], error.code().value())};
  }
  out.close_write_end();
  err.close_write_end();
  Listener listener(*openscad, out, err);
  if (!listener.listen(deadline, stop)) {
    return {std::nullopt, listener.is_too_large() ? "openscad writes more than 1 GiB"
                                                  : "openscad has not finished in time: give it "
                                                    "more by --openscad-timeout"};
  }
  return result_of(listener.output(), format, listener.messages(), openscad->wait());
}

std::vector<Rendering> render_all(std::span<const RenderRequest> requests,
                                  const RenderingOptions& options, const std::stop_token& stop) {
  const DifferentRequests different(requests);
  std::vector<Rendering> renderings(different.all.size());
  const RenderCache cache;
  const auto limit = std::chrono::duration<double>(std::min(options.timeout_s, kLongest_s));
  RenderThreads threads(different.all, renderings, cache, openscad_identity(),
                        Clock::now() + std::chrono::duration_cast<Clock::duration>(limit));
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < renderings.size(); ++i) {
    throw_if_stopped(stop);
    if (std::optional<RingedFaces> faces = cache.find(threads.key_of(*different.all[i]))) {
      renderings[i].faces = std::make_shared<const RingedFaces>(std::move(*faces));
    } else {
      missing.push_back(i);
    }
  }
  if (options.waits && !missing.empty()) threads.run(std::move(missing), options, stop);
  throw_if_stopped(stop);
  std::vector<Rendering> result;
  for (const std::size_t index : different.index_of) result.push_back(renderings[index]);
  return result;
}

}  // namespace frontend
