// Drops files on a window, as a file manager does.
#pragma once

#include <string>
#include <vector>

namespace window_test {

/// Drags the files over the middle of a window of this display, and drops them there, by the
/// protocol Xdnd. Returns whether the window has taken them.
bool drop_files(const std::string& display_name, unsigned long window,
                const std::vector<std::string>& paths);

}  // namespace window_test
