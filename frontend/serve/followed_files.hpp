// Tells when files change that followed documents read.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace serve {

/// Its end waits for `on_change`, if that is being called.
class FollowedFiles {
 public:
  /// `on_change` is called by another thread once a file has changed and its writer is done.
  explicit FollowedFiles(std::function<void()> on_change);
  ~FollowedFiles();

  // These may be called by any thread, and do not wait.

  /// Watches these files from now on, by their absolute paths: those that were read, and those that
  /// were looked for and not there.
  void set(const std::vector<std::string>& read, const std::vector<std::string>& missing);
  /// To be called before files are read that set() will name: what changes from now on counts.
  void note_reading();

 private:
  class Watch;
  std::unique_ptr<Watch> watch_;
};

}  // namespace serve
