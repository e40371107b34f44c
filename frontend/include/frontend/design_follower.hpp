// Follows a design's file: reads it anew after every save, in a thread of its own, for the live
// window.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frontend/activity.hpp"
#include "frontend/design_file_options.hpp"
#include "frontend/design_version.hpp"
#include "frontend/import_options.hpp"

namespace frontend {

struct FollowOptions : ReadingOptions {
  /// Look at the files at intervals only, as if the system could not watch them. By default only
  /// those are looked at that the system cannot watch: missing files, and files on file systems
  /// that other machines may write to.
  bool polls = false;
  /// The interval of those looks.
  std::chrono::milliseconds poll_interval{250};
};

/// Follows a .scad and everything that it reads, or a .csg. Standard input ("-") is read once.
///
/// A save stops a reading that is under way, and openscad with everything that it has started. So
/// at most one openscad runs at any time, and none is left when this object ends, or when a signal
/// ends the program (interrupt.hpp).
class DesignFollower {
 public:
  enum class State : uint8_t { kIdle, kReading, kStopped };

  /// Starts reading at once. `on_news` is called from any thread whenever the result of take() or
  /// state() has changed; it must neither block nor throw.
  DesignFollower(std::string path, FollowOptions options, std::function<void()> on_news);
  /// Returns promptly: it stops what is being read. `on_news` is not called afterwards.
  ~DesignFollower();
  DesignFollower(const DesignFollower&) = delete;
  DesignFollower& operator=(const DesignFollower&) = delete;
  /// Follows another design in place of this one, as if made anew.
  DesignFollower& operator=(DesignFollower&&) noexcept;

  // These may be called from any thread, and do not wait.

  /// Returns the newest version, each at most once: nothing if there is none newer than the one
  /// taken last. Versions that were not taken in time are skipped.
  std::optional<DesignVersion> take();
  /// kReading lasts from the notice of a save until its version can be taken, kStopped from a
  /// stop() until the next reading.
  State state() const;
  /// Returns what is being done.
  std::optional<Activity> activity() const;
  /// Reads the design again, as after a save.
  void reload();
  /// Ends what is being done: from now on there is no activity, and no version of it can be taken.
  /// The last version that was taken stays, and the next save is followed.
  void stop();
  /// Reads the design with other inputs; the newest ones come next. A reading that is under way is
  /// shown first, unless it has taken long. Of what can be read only once the text is kept.
  void set_inputs(DesignInputs inputs);

 private:
  class Follower;
  std::unique_ptr<Follower> follower_;
};

}  // namespace frontend
