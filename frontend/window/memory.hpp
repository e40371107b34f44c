// What the window remembers from run to run, in a file of the user's XDG state.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "frontend/options.hpp"
#include "glfw_window.hpp"
#include "state.hpp"

namespace window {

/// Nothing fails: what cannot be read is not remembered, and what cannot be written is forgotten.
/// Several windows may share the file: each writes what its user has changed.
class Memory {
 public:
  using Clock = std::chrono::steady_clock;
  using Values = std::map<std::string, std::string>;

  /// Reads the file at `path`; empty: there is none. Holds a lock as long as it lives if no other
  /// window has it. `forgets`: all values that the file has are forgotten, but not the designs.
  explicit Memory(std::string path, bool forgets = false);
  ~Memory();
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  /// Returns a value as it was remembered when the window opened; null if it was not.
  const std::string* find(const std::string& name) const;
  /// Returns the designs that were opened last, the newest first, by their absolute paths.
  const std::vector<std::string>& recent() const { return recent_; }
  /// Returns whether no other window was open when this one was opened.
  bool is_only_window() const { return is_only_window_; }

  /// Puts a design's absolute path first among the recent ones.
  void note_design(const std::string& path, Clock::time_point now);
  /// Notes the values as they are. Those that differ from the ones noted before are remembered
  /// from now on; those that are noted first are what the window has begun with.
  void note(const Values& values, Clock::time_point now);
  /// Notes that something may have changed which is noted when it is written.
  void touch(Clock::time_point now);

  /// Returns when to write what has changed: some time after the change, since more may follow.
  std::optional<Clock::time_point> due() const { return due_; }
  /// Writes what has changed.
  void write();

 private:
  bool take_lock();
  void make_folder();

  const std::string path_;
  Values values_;  // when the window opened
  Values noted_;
  Values changed_;  // to be written
  bool forgets_;    // the file's values, when it is written
  std::vector<std::string> recent_;
  std::vector<std::string> opened_;  // by this window, the newest first
  std::optional<Clock::time_point> due_;
  int lock_ = -1;  // a descriptor
  bool is_only_window_ = true;
};

/// Returns the file's path: scadray/window in $XDG_STATE_HOME, or else in ~/.local/state. Empty
/// without $HOME.
std::string memory_path();

// The habits of the user, as text: what of the window's state is remembered.

/// Returns what the user has chosen for all designs: colours, projection, shading, smooth edges,
/// and what is switched on.
Memory::Values habits_of(const State& state);

/// Makes these choices as they are remembered, but for those that the command line makes.
void restore_habits(const Memory& memory, const frontend::GivenLook& given, State& state);

/// Returns the window's size, and its position if that is the only window's.
Memory::Values values_of(const Placement& placement, bool has_position);

/// Returns the remembered placement, without a position if another window is open. The size is the
/// given one, or else the remembered one, or else the default.
Placement remembered_placement(const Memory& memory, const std::optional<Size>& given);

}  // namespace window
