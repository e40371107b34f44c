// A display for programs that need one.
#pragma once

#include <sys/types.h>

#include <string>

namespace measure {

/// An Xvfb of this program's own, until its end.
class XServer {
 public:
  /// Waits until the server answers. running() is false if there is no Xvfb, or it fails.
  XServer();
  ~XServer();
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;

  bool running() const { return !display_.empty(); }
  /// ":N".
  const std::string& display() const { return display_; }

 private:
  pid_t process_ = 0;
  std::string display_;
};

}  // namespace measure
