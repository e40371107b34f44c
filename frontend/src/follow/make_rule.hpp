// Rules of make, as `openscad -d` writes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace frontend {

/// The prerequisites of a rule that OpenSCAD wrote: one a line, their spaces escaped, and nothing
/// else; a name may hold a line break.
std::vector<std::string> prerequisites_of(std::string_view rule);

/// A rule in the same form, which GNU make reads with these very names: what it takes for its own
/// (`:`, `#`, `$`, `;`, `=`, `%`, `|`, wildcards, …) is escaped. Throws Error for a name that no
/// rule can hold: one with a line break, one that ends in `)` (a member of an archive to make), and
/// a target with `%` and a wildcard.
std::string make_rule(const std::vector<std::string>& targets,
                      const std::vector<std::string>& prerequisites);

}  // namespace frontend
