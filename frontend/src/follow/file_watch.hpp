// Tells which files have changed, and whether their writer is done.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/descriptor.hpp"
#include "language/file_signature.hpp"

struct inotify_event;

namespace frontend {

/// The lookup of one name in one folder, when the system resolves a path.
struct PathLookup {
  std::string folder;  // its path, without links
  std::string name;
  bool is_last = false;  // the last name of the path, or of a link in its place: the file itself
};

/// Calls `visit` for each name that an absolute path is resolved through, links' targets included.
/// The call comes before the name is examined, so that no change is missed if visit watches the
/// folder. Ends after the first name that is missing.
void visit_lookups(const std::string& path, const std::function<void(const PathLookup&)>& visit);

/// Watches files, which may be missing: their contents, and every folder and link on their paths.
/// It uses inotify, and also looks at the files at intervals where inotify does not report every
/// change.
///
/// A save is not one event. A file that was closed after writing, or put in place by renaming, is
/// most likely complete. One that was only written to, or that is missing or empty, is most likely
/// not.
class FileWatch {
 public:
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::milliseconds;

  // A file counts as complete once it has stayed unchanged for one of these times.

  /// After closing or renaming: other files of the same save, or permissions, may follow at once.
  static constexpr Milliseconds kSettleClosed{3};
  /// After writing without closing: longer than an editor pauses between two writes.
  static constexpr Milliseconds kSettleOpen{40};
  /// Missing or empty: an editor has moved the old file away, or truncated it, and is writing.
  static constexpr Milliseconds kSettleMissing{200};

  /// `only_polls`: do without inotify.
  FileWatch(bool only_polls, Milliseconds poll_interval);

  /// Returns the time for set_files().
  static int64_t system_time_ns();

  /// Watches these files from now on, by their absolute paths. Changes of files that were watched
  /// before stay noted. A file that was not, and that the caller has read since `since` (the system
  /// clock, in ns), counts as changed if it changed after that.
  void set_files(const std::vector<std::string>& paths, std::optional<int64_t> since = {});

  /// A descriptor that is readable when update() may have news; -1: only next_look() says when to
  /// call it.
  int descriptor() const { return inotify_ ? inotify_->number() : -1; }
  /// The latest time to call update(); nothing: there is no need.
  std::optional<Clock::time_point> next_look() const;
  /// Takes note of what has happened. Returns whether a file has changed since the last call.
  bool update();
  /// When all changes count as complete, unless more happen; nothing: there were none since the
  /// last forget_changes().
  std::optional<Clock::time_point> settled_at() const;
  /// To be called when reading the files begins.
  void forget_changes();

  /// Returns whether this system learns of every change of files on such a file system (statfs's
  /// f_type). False if that is unknown.
  static bool tells_of_every_change(long file_system_type);

 private:
  struct File {
    std::string path;
    language::FileSignature signature;
    std::optional<Clock::time_point> settled_at;  // when its change counts as complete
  };
  /// A file that depends on a name in a folder. `is_last`: the name is the file's own.
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
  std::map<int, std::vector<std::size_t>> content_;  // by inotify's number; indices into files_
  bool watches_all_ = false;                         // inotify reports every change
  bool outdated_ = false;                            // an event has outdated the watches
  bool has_news_ = false;
  Clock::time_point last_look_{};
};

/// Waits until `wake` is raised, which it then lowers, or the watch may have news, or it is
/// `until`.
void wait_for_news(const FileWatch& watch, const Event& wake,
                   std::optional<FileWatch::Clock::time_point> until);

}  // namespace frontend
