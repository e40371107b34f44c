// A design's file read anew after every save, in a thread of its own, for the live window.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frontend/design_version.hpp"
#include "frontend/import_options.hpp"

namespace frontend {

struct FollowOptions {
  std::vector<std::string> openscad_arguments;  // handed on to openscad for a .scad
  ImportOptions import;
  /// Look at the files from time to time only, as if the system could not watch them. Without it
  /// that is done for files that are missing, for file systems that other machines may write to,
  /// and where the system cannot watch them.
  bool polls = false;
  /// How often, where it is done.
  std::chrono::milliseconds poll_interval{250};
};

/// Follows a .scad and everything that it reads, or a .csg. "-", standard input, is read once.
///
/// A save stops a reading that is under way, openscad with all that it started: at most one runs at
/// any time, and none is left when this object, or the program by a signal, ends (interrupt.hpp).
class DesignFollower {
 public:
  enum class State : uint8_t { kIdle, kReading };

  /// Starts to read at once. `on_news` is called from a thread of this object's own, whenever
  /// take() or state() would say something new; it must not block, nor throw.
  DesignFollower(std::string path, FollowOptions options, std::function<void()> on_news);
  /// Prompt: stops what is being read. `on_news` is not called any more.
  ~DesignFollower();
  DesignFollower(const DesignFollower&) = delete;
  DesignFollower& operator=(const DesignFollower&) = delete;

  // From any thread; none of these waits.

  /// The newest version, once: nothing until there is one newer than that taken last. Versions that
  /// were not taken in time are passed over.
  std::optional<DesignVersion> take();
  /// kReading from when a save is noticed until its version can be taken.
  State state() const;
  /// Reads again, as if saved.
  void reload();

 private:
  class Follower;
  std::unique_ptr<Follower> follower_;
};

}  // namespace frontend
