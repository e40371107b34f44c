#include "rendered/rendering.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "base/elapsed.hpp"
#include "frontend/stop.hpp"
#include "process/openscad_program.hpp"
#include "rendered/openscad_process.hpp"
#include "rendered/render_cache.hpp"

namespace frontend {
namespace {

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
