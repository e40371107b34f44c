// Rules of make, as `openscad -d` writes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace frontend {

/// The prerequisites of a rule that OpenSCAD wrote: one a line, their spaces escaped, and nothing
/// else.
std::vector<std::string> prerequisites_of(std::string_view rule);

/// A rule in the same form. What make reads as its own (`$` and `#`) is escaped, too.
std::string make_rule(const std::vector<std::string>& targets,
                      const std::vector<std::string>& prerequisites);

}  // namespace frontend
