#include "frontend/design_follower.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <mutex>
#include <set>
#include <stop_token>
#include <thread>
#include <utility>

#include "base/descriptor.hpp"
#include "base/elapsed.hpp"
#include "follow/design_reading.hpp"
#include "follow/file_watch.hpp"
#include "follow/input_turn.hpp"
#include "frontend/design_file.hpp"
#include "frontend/files.hpp"
#include "frontend/stop.hpp"
#include "language/evaluation_cache.hpp"
#include "solids/solid_pool.hpp"

namespace frontend {
namespace {

std::string absolute(const std::string& path) {
  std::error_code failed;  // the working folder is gone
  const std::filesystem::path result = std::filesystem::absolute(path, failed);
  return failed ? path : result.string();
}

}  // namespace

/// Runs two threads: one watches the files and decides, and, while there is something to read, one
/// reads. A newer save stops the reading thread, and waits for its end before the next one starts.
/// So there is never more than one openscad.
class DesignFollower::Follower {
 public:
  Follower(std::string path, FollowOptions options, std::function<void()> on_news)
      : path_(std::move(path)),
        options_(std::move(options)),
        on_news_(std::move(on_news)),
        is_followed_(!is_read_once(path_)),
        watch_(options_.polls, options_.poll_interval),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  ~Follower() {
    thread_.request_stop();
    wake_.raise();
    thread_.join();
  }

  std::optional<DesignVersion> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, std::nullopt);
  }

  State state() const { return state_; }

  std::optional<Activity> activity() const { return activity_.current(); }

  void reload() {
    wants_reload_ = true;
    wake_.raise();
  }

  void stop() {
    has_new_inputs_ = false;  // those that come later count
    wants_reload_ = false;
    {
      const std::lock_guard lock(mutex_);
      wants_stop_ = true;
      reading_stop_.request_stop();
      news_.reset();
    }
    activity_.end();
    set_state(State::kStopped);
    wake_.raise();
  }

  void set_inputs(DesignInputs inputs) {
    {
      const std::lock_guard lock(mutex_);
      inputs_ = std::move(inputs);
    }
    has_new_inputs_ = true;
    wake_.raise();
  }

 private:
  void run(const std::stop_token& stop) {
    noticed_ = Clock::now();
    start_reading();
    while (!stop.stop_requested()) {
      wait();
      if (wants_stop_.exchange(false)) give_up();
      if (is_followed_ && watch_.update()) notice(Clock::now());
      if (is_followed_ && wants_reload_.exchange(false)) notice(Clock::now());
      if (has_new_inputs_.exchange(false)) notice_inputs();
      if (has_read_.exchange(false)) finish_reading();
      if (const auto due = inputs_due(); due && Clock::now() >= *due) read_with_new_inputs();
      if (noticed_ && Clock::now() >= watch_.settled_at().value_or(Clock::time_point::min())) {
        start_reading();
      }
    }
    stop_reading();
  }

  /// Waits until there may be something to do.
  void wait() {
    std::optional<Clock::time_point> until = is_followed_ ? watch_.next_look() : std::nullopt;
    if (noticed_) {
      const Clock::time_point settled = watch_.settled_at().value_or(Clock::time_point::min());
      until = until ? std::min(*until, settled) : settled;
    } else if (const auto due = inputs_due()) {
      until = until ? std::min(*until, *due) : due;
    }
    wait_for_news(watch_, wake_, until);
  }

  /// Notes that there is something newer than what is being read, or was read last.
  void notice(Clock::time_point when) {
    if (reading_.joinable()) {
      stop_reading();
      noticed_ = when;
    } else if (!noticed_) {
      noticed_ = when;
    }
    set_state(State::kReading);
  }

  /// Ends what is being done, at the user's wish.
  void give_up() {
    stop_reading();
    noticed_.reset();
    turn_.give_up();
    set_state(State::kStopped);
  }

  void notice_inputs() {
    turn_.notice(Clock::now());
    set_state(State::kReading);
  }

  /// Returns when to read with new inputs; nothing if there are none, or a save is read with them.
  std::optional<Clock::time_point> inputs_due() const {
    if (noticed_) return std::nullopt;
    return turn_.due(reading_.joinable() ? std::optional(reading_since_) : std::nullopt);
  }

  void read_with_new_inputs() {
    noticed_ = turn_.noticed();
    turn_.start(reading_.joinable());
    stop_reading();
  }

  /// Runs `read`, which returns a DesignReading, in a thread of its own.
  template <typename Read>
  void start(const Read& read) {
    reading_ = std::jthread([this, read](const std::stop_token& stop) {
      try {
        result_ = read(stop);
        has_read_ = true;
        wake_.raise();
      } catch (const Stopped&) {
      }
    });
    const std::lock_guard lock(mutex_);
    reading_stop_ = reading_.get_stop_source();
  }

  void start_reading() {
    const Clock::time_point noticed = *std::exchange(noticed_, std::nullopt);
    turn_.start(false);
    reading_since_ = Clock::now();
    watch_.forget_changes();
    if (is_followed_) watch_.set_files(paths_to_watch());
    reading_since_ns_ = FileWatch::system_time_ns();
    set_state(State::kReading);
    activity_.begin("reading");
    has_new_inputs_ = false;
    start([this, noticed, options = file_options(), before = good_](const std::stop_token& stop) {
      DesignReading reading = read_anew(path_, options, before, stop);
      reading.version.noticed = noticed;
      return reading;
    });
  }

  DesignFileOptions file_options() {
    DesignFileOptions options{options_};
    options.import.solids = solids_;
    options.camera = language::CameraChoice::kWindow;
    options.cache = cache_;
    options.progress = [this](const char* stage) { activity_.update(stage); };
    {
      const std::lock_guard lock(mutex_);
      options.inputs = inputs_;
      options.import.language = inputs_.language.value_or(options.import.language);
    }
    return options;
  }

  void stop_reading() {
    if (!reading_.joinable()) return;
    reading_.request_stop();
    reading_.join();
    activity_.end();
    has_read_ = false;
  }

  void finish_reading() {
    reading_.join();
    activity_.end();
    turn_.finish();
    good_ = std::move(result_.good);
    if (!result_.watched.empty()) watched_ = std::move(result_.watched);
    DesignVersion version = std::move(result_.version);
    if (version.error.empty()) imports_ = std::move(version.files);
    if (is_followed_) watch_.set_files(paths_to_watch(), reading_since_ns_);
    version.files = files_;
    version.number = ++number_;
    {
      const std::lock_guard lock(mutex_);
      if (wants_stop_) return;
      news_ = std::move(version);
    }
    state_ = turn_.noticed() ? State::kReading : State::kIdle;
    on_news_();
  }

  void set_state(State state) {
    if (state_.exchange(state) != state) on_news_();
  }

  /// Returns the files that the last evaluation has read or looked for, and those that the last
  /// version that could be read has read, since openscad names none after an error. Stores their
  /// names in files_.
  std::vector<std::string> paths_to_watch() {
    files_.clear();
    std::vector<std::string> paths;
    std::set<std::string> seen;
    const auto add = [&](const std::string& name) {
      std::string path = absolute(name);
      if (!seen.insert(path).second) return;
      files_.push_back(name);
      paths.push_back(std::move(path));
    };
    add(path_);
    for (const std::string& name : watched_) add(name);
    for (const std::string& name : imports_) add(name);
    return paths;
  }

  const std::string path_;
  const FollowOptions options_;
  const std::function<void()> on_news_;
  const bool is_followed_;

  // Shared by all threads.
  Event wake_;
  std::atomic<State> state_{State::kReading};
  std::atomic<bool> wants_reload_{false};
  std::atomic<bool> wants_stop_{false};
  ActivityMeter activity_;
  std::atomic<bool> has_new_inputs_{false};
  std::mutex mutex_;  // of the following
  std::optional<DesignVersion> news_;
  DesignInputs inputs_;
  std::stop_source reading_stop_;  // of the reading thread

  // Used by the watching thread alone.
  FileWatch watch_;
  std::vector<std::string> files_;  // watched files, by their names
  /// Solids of the last version that was read to its end.
  const std::shared_ptr<SolidPool> solids_ = std::make_shared<SolidPool>(SolidPool::Keeps::kAll);
  /// What the evaluator keeps of the last version.
  const std::shared_ptr<language::EvaluationCache> cache_ =
      std::make_shared<language::EvaluationCache>();
  std::vector<std::string> watched_;  // what the last evaluation has read or looked for
  std::vector<std::string> imports_;  // files that the last version that could be read has read
  GoodVersion good_;
  uint64_t number_ = 0;
  std::optional<Clock::time_point> noticed_;  // when the save that is still to be read was noticed
  InputTurn turn_;
  int64_t reading_since_ns_ = 0;
  Clock::time_point reading_since_{};  // the same by the other clock

  // Written by the reading thread, and read after its end.
  DesignReading result_;
  std::atomic<bool> has_read_{false};
  std::jthread reading_;

  std::jthread thread_;  // declared last, since it uses all others
};

DesignFollower::DesignFollower(std::string path, FollowOptions options,
                               std::function<void()> on_news)
    : follower_(
          std::make_unique<Follower>(std::move(path), std::move(options), std::move(on_news))) {}

DesignFollower::~DesignFollower() = default;
DesignFollower& DesignFollower::operator=(DesignFollower&&) noexcept = default;

std::optional<DesignVersion> DesignFollower::take() { return follower_->take(); }

DesignFollower::State DesignFollower::state() const { return follower_->state(); }

std::optional<Activity> DesignFollower::activity() const { return follower_->activity(); }

void DesignFollower::reload() { follower_->reload(); }

void DesignFollower::stop() { follower_->stop(); }
void DesignFollower::set_inputs(DesignInputs inputs) { follower_->set_inputs(std::move(inputs)); }

}  // namespace frontend
