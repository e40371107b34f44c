#include "follow/file_watch.hpp"

#include <linux/magic.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

namespace frontend {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as in the kernel

/// Pushes the names of a path, the first one last.
void push_names(const fs::path& path, std::vector<std::string>& names) {
  const std::size_t before = names.size();
  for (const fs::path& name : path.relative_path()) {
    if (!name.empty() && name != ".") names.push_back(name.string());
  }
  std::reverse(names.begin() + static_cast<std::ptrdiff_t>(before), names.end());
}

constexpr uint32_t kNameEvents =
    IN_CREATE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_ONLYDIR | IN_MASK_ADD;
/// A file that was just made may have no watch of its own yet, so that its folder tells of its
/// closing.
constexpr uint32_t kLastFolderEvents = kNameEvents | IN_CLOSE_WRITE;
constexpr uint32_t kContentEvents = IN_MODIFY | IN_CLOSE_WRITE | IN_ATTRIB | IN_MASK_ADD;

/// The longest tick of the clock that file systems use; that clock lags behind the system's.
constexpr int64_t kFileClockTick_ns = 10'000'000;

// Not in linux/magic.h.
constexpr long kZfs = 0x2FC12FC1, kBcachefs = 0xCA451A4E, kNtfs3 = 0x7366746E, kJfs = 0x3153464A;

/// Returns whether inotify reports every change in the folder. False also if the system cannot say.
bool is_told_of(const std::string& folder) {
  struct statfs status {};
  return statfs(folder.c_str(), &status) == 0 && FileWatch::tells_of_every_change(status.f_type);
}

}  // namespace

void visit_lookups(const std::string& path, const std::function<void(const PathLookup&)>& visit) {
  std::vector<std::string> names;  // names still to be looked up, the next one last
  push_names(path, names);
  fs::path folder = "/";
  for (int links = 0; !names.empty();) {
    const std::string name = std::move(names.back());
    names.pop_back();
    if (name == "..") {
      folder = folder.parent_path();
      continue;
    }
    visit({folder.string(), name, names.empty()});
    const fs::path found = folder / name;
    std::error_code failed;
    const fs::file_status status = fs::symlink_status(found, failed);
    if (!fs::exists(status)) return;
    if (!fs::is_symlink(status)) {
      folder = found;
      continue;
    }
    const fs::path target = fs::read_symlink(found, failed);
    if (failed || ++links > kMostLinks) return;
    if (target.is_absolute()) folder = "/";
    push_names(target, names);
  }
}

bool FileWatch::tells_of_every_change(long file_system_type) {
  switch (file_system_type) {
    case EXT4_SUPER_MAGIC:  // also ext2 and ext3
    case XFS_SUPER_MAGIC:
    case BTRFS_SUPER_MAGIC:
    case F2FS_SUPER_MAGIC:
    case REISERFS_SUPER_MAGIC:
    case NILFS_SUPER_MAGIC:
    case TMPFS_MAGIC:
    case RAMFS_MAGIC:
    case OVERLAYFS_SUPER_MAGIC:
    case ECRYPTFS_SUPER_MAGIC:
    case MSDOS_SUPER_MAGIC:
    case EXFAT_SUPER_MAGIC:
    case ISOFS_SUPER_MAGIC:
    case UDF_SUPER_MAGIC:
    case SQUASHFS_MAGIC:
    case kZfs:
    case kBcachefs:
    case kNtfs3:
    case kJfs:
      return true;
    default:
      return false;
  }
}

FileWatch::FileWatch(bool only_polls, Milliseconds poll_interval) : poll_interval_(poll_interval) {
  if (only_polls) return;
  const int inotify = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  if (inotify >= 0) inotify_.emplace(inotify);  // it fails if the user's instances are used up
}

void FileWatch::set_files(const std::vector<std::string>& paths, std::optional<int64_t> since) {
  if (std::equal(paths.begin(), paths.end(), files_.begin(), files_.end(),
                 [](const std::string& path, const File& file) { return path == file.path; })) {
    return;
  }
  std::map<std::string, File> before;
  for (File& file : files_) {
    std::string path = file.path;
    before.emplace(std::move(path), std::move(file));
  }
  files_.clear();
  for (const std::string& path : paths) {
    const auto known = before.find(path);
    if (known != before.end()) {
      files_.push_back(std::move(known->second));
    } else {
      files_.push_back({path, {}, {}});
    }
  }
  arm();
  for (File& file : files_) {
    if (before.contains(file.path)) continue;
    file.signature = language::FileSignature(file.path);
    if (since && file.signature.changed_ns() >= *since - kFileClockTick_ns) {
      changed(file, kSettleOpen);
    }
  }
}

bool FileWatch::is_polled() const {
  return !watches_all_ || std::any_of(files_.begin(), files_.end(),
                                      [](const File& file) { return !file.signature.exists(); });
}

std::optional<FileWatch::Clock::time_point> FileWatch::next_look() const {
  if (outdated_ || has_news_) return Clock::now();
  if (!is_polled()) return std::nullopt;
  const Clock::time_point next = last_look_ + poll_interval_;
  const std::optional<Clock::time_point> settled = settled_at();
  return settled ? std::min(next, *settled) : next;
}

std::optional<FileWatch::Clock::time_point> FileWatch::settled_at() const {
  std::optional<Clock::time_point> latest;
  for (const File& file : files_) latest = std::max(latest, file.settled_at);
  return latest;
}

void FileWatch::forget_changes() {
  for (File& file : files_) file.settled_at.reset();
}

bool FileWatch::update() {
  if (inotify_) read_events();
  const std::optional<Clock::time_point> next = next_look();
  if (!outdated_ && next && Clock::now() >= *next) look();
  if (outdated_) {
    arm();
    look();  // files may have come into a folder that was not watched before
  }
  return std::exchange(has_news_, false);
}

void FileWatch::look() {
  last_look_ = Clock::now();
  for (File& file : files_) {
    if (language::FileSignature(file.path) == file.signature) continue;
    changed(file, kSettleOpen);
    outdated_ = true;
  }
}

void FileWatch::changed(File& file, Milliseconds settle) {
  const bool was_missing = !file.signature.exists();
  file.signature = language::FileSignature(file.path);
  if (!file.signature.exists() && was_missing) return;
  if (!file.signature.exists() || file.signature.is_empty()) settle = kSettleMissing;
  file.settled_at = Clock::now() + settle;
  has_news_ = true;
}

void FileWatch::changed_all(Milliseconds settle) {
  for (File& file : files_) changed(file, settle);
}

/// Replaces the watches by those of everything that the files depend on.
void FileWatch::arm() {
  outdated_ = false;
  watches_all_ = inotify_.has_value();
  if (!inotify_) return;
  std::set<int> before;
  for (const auto& [number, names] : folders_) before.insert(number);
  for (const auto& [number, files] : content_) before.insert(number);
  folders_.clear();
  content_.clear();

  std::map<std::string, int> known;
  for (std::size_t i = 0; i < files_.size(); ++i) {
    visit_lookups(files_[i].path, [&](const PathLookup& lookup) {
      watch_folder(i, lookup.folder, lookup.name, lookup.is_last, known);
    });
    const int number = watch(files_[i].path, kContentEvents);
    if (number >= 0) content_[number].push_back(i);
  }
  for (const int number : before) {
    if (!folders_.contains(number) && !content_.contains(number)) {
      inotify_rm_watch(inotify_->number(), number);
    }
  }
}

void FileWatch::watch_folder(std::size_t file, const std::string& folder, const std::string& name,
                             bool is_last, std::map<std::string, int>& known) {
  const auto [entry, is_new] = known.try_emplace(folder, -1);
  int& number = entry->second;
  if (is_new) {
    number = watch(folder, kNameEvents);
    watches_all_ = watches_all_ && is_told_of(folder);
  }
  if (number < 0) return;
  if (is_last) watch(folder, kLastFolderEvents);
  folders_[number].emplace(name, Dependence{file, is_last});
}

int FileWatch::watch(const std::string& path, uint32_t mask) {
  const int number = inotify_add_watch(inotify_->number(), path.c_str(), mask);
  // If a name vanishes while it is examined, the watch of its folder reports that.
  if (number < 0 && errno != ENOENT && errno != ENOTDIR) watches_all_ = false;
  return number;
}

void FileWatch::read_events() {
  alignas(inotify_event) std::array<char, 65536> buffer;
  while (true) {
    const ssize_t count = read(inotify_->number(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;  // EAGAIN: there is nothing more
    for (ssize_t at = 0; at < count;) {
      const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
      on_event(*event);
      at += static_cast<ssize_t>(sizeof *event + event->len);
    }
  }
}

void FileWatch::on_event(const inotify_event& event) {
  if ((event.mask & IN_Q_OVERFLOW) != 0) {
    outdated_ = true;
    return changed_all(kSettleOpen);
  }
  const auto content = content_.find(event.wd);
  if (content != content_.end() && event.len == 0) {
    for (const std::size_t i : content->second) {
      File& file = files_[i];
      if ((event.mask & (IN_MODIFY | IN_CLOSE_WRITE)) != 0) {
        changed(file, (event.mask & IN_CLOSE_WRITE) != 0 ? kSettleClosed : kSettleOpen);
      } else if (language::FileSignature(file.path) != file.signature) {
        changed(file, kSettleClosed);
      }
    }
  }
  const auto folder = folders_.find(event.wd);
  if (folder == folders_.end()) return;
  if ((event.mask & (IN_IGNORED | IN_UNMOUNT)) != 0) outdated_ = true;
  if (event.len == 0) return;
  const bool is_closed = (event.mask & IN_CLOSE_WRITE) != 0;
  const bool is_complete = (event.mask & (IN_CLOSE_WRITE | IN_MOVED_TO)) != 0;
  const auto [first, last] = folder->second.equal_range(event.name);
  for (auto it = first; it != last; ++it) {
    if (is_closed && !it->second.is_last) continue;
    changed(files_[it->second.file], is_complete ? kSettleClosed : kSettleOpen);
    outdated_ = outdated_ || !is_closed;
  }
}

int64_t FileWatch::system_time_ns() {
  return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
}

void wait_for_news(const FileWatch& watch, const Event& wake,
                   std::optional<FileWatch::Clock::time_point> until) {
  timespec timeout{};
  if (until) {
    const auto rest =
        std::max(*until - FileWatch::Clock::now(), FileWatch::Clock::duration::zero());
    const auto seconds = std::chrono::floor<std::chrono::seconds>(rest);
    timeout.tv_sec = seconds.count();
    timeout.tv_nsec = std::chrono::nanoseconds(rest - seconds).count();
  }
  std::array<pollfd, 2> waits = {pollfd{wake.descriptor(), POLLIN, 0},
                                 pollfd{watch.descriptor(), POLLIN, 0}};
  ppoll(waits.data(), waits.size(), until ? &timeout : nullptr, nullptr);
  wake.clear();
}

}  // namespace frontend
