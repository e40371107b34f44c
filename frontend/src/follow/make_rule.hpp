// Rules of make, as `openscad -d` writes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace frontend {

/// Returns the prerequisites of a rule that OpenSCAD wrote: one a line, only spaces escaped. A name
/// may contain a line break.
std::vector<std::string> prerequisites_of(std::string_view rule);

/// Returns a rule in the same form, from which GNU make reads exactly these names: its special
/// characters (`:`, `#`, `$`, `;`, `=`, `%`, `|`, wildcards, …) are escaped. Throws Error for a
/// name that no rule can hold: one with a line break, one that ends in `)` (to make, a member of an
/// archive), and a target with both `%` and a wildcard.
std::string make_rule(const std::vector<std::string>& targets,
                      const std::vector<std::string>& prerequisites);

}  // namespace frontend
