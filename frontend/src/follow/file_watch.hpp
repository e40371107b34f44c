// Which files have been changed, and whether their writer is done.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/descriptor.hpp"
#include "follow/file_signature.hpp"

struct inotify_event;

namespace frontend {

/// Watches files, wherever their paths lead, existing or not: their contents, and every folder and
/// link on the way to them. By inotify; where that does not tell all, by looking at them from time
/// to time, too.
///
/// A save is not one event. What has been closed after writing, or was put in place by renaming, is
/// most likely complete; what has only been written to, or is missing or empty, is most likely not.
class FileWatch {
 public:
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::milliseconds;

  // How long a file has to stay as it is before it counts as complete.
  /// Closed or renamed: others written by the same save, or its permissions, may follow at once.
  static constexpr Milliseconds kSettleClosed{3};
  /// Written to, but not closed: longer than an editor pauses between two writes.
  static constexpr Milliseconds kSettleOpen{40};
  /// Missing or empty: an editor has moved the old file away, or truncated it, and now writes.
  static constexpr Milliseconds kSettleMissing{200};

  /// `only_polls`: do without inotify.
  FileWatch(bool only_polls, Milliseconds poll_interval);

  /// From here on these files are watched, by their absolute paths. Changes of those watched before
  /// stay known. Others, that the caller has read since `since` (the system clock, in ns), count as
  /// changed where they changed after that.
  void set_files(const std::vector<std::string>& paths, std::optional<int64_t> since = {});

  /// Readable by poll when update() may have news; -1: it has to be called at next_look() only.
  int descriptor() const { return inotify_ ? inotify_->number() : -1; }
  /// When update() is to be called at the latest; nothing: there is no need.
  std::optional<Clock::time_point> next_look() const;
  /// Takes in what has happened. True if a file has been changed since the last call.
  bool update();
  /// When all that has been changed counts as complete, unless more happens; nothing: nothing has
  /// been changed since the last forget_changes().
  std::optional<Clock::time_point> settled_at() const;
  /// To be called when reading the files begins.
  void forget_changes();

  /// False where files can change without this system's knowledge, or nobody knows (statfs's
  /// f_type).
  static bool tells_of_every_change(long file_system_type);

 private:
  struct File {
    std::string path;
    FileSignature signature;
    std::optional<Clock::time_point> settled_at;  // of a change
  };
  /// A file that depends on a name in a folder.
  struct Dependence {
    std::size_t file;
    bool is_last;
  };
  using Names = std::multimap<std::string, Dependence>;

  void arm();
  int watch(const std::string& path, uint32_t mask);
  void watch_folder(std::size_t file, const std::string& folder, const std::string& name,
                    bool is_last, std::map<std::string, int>& known);
  void read_events();
  void on_event(const inotify_event& event);
  void look();
  void changed(File& file, Milliseconds settle);
  void changed_all(Milliseconds settle);
  bool is_polled() const;

  Milliseconds poll_interval_;
  std::optional<Descriptor> inotify_;
  std::vector<File> files_;
  std::map<int, Names> folders_;                     // by inotify's number
  std::map<int, std::vector<std::size_t>> content_;  // by inotify's number; of files_
  bool watches_all_ = false;                         // every change is told of by inotify
  bool outdated_ = false;                            // the watches, by an event
  bool has_news_ = false;
  Clock::time_point last_look_{};
};

}  // namespace frontend
