#include "evaluation/kept_tops.hpp"

#include <algorithm>

namespace language {

std::vector<uint64_t> unit_identity(const Program& program, uint32_t unit) {
  std::vector<uint64_t> identity;
  std::vector<uint32_t> found = {unit};  // in order; each adds its text, and what its uses are
  for (size_t i = 0; i < found.size(); ++i) {
    const Unit& next = program.units[found[i]];
    identity.push_back(next.versions.size());
    identity.insert(identity.end(), next.versions.begin(), next.versions.end());
    identity.push_back(next.uses.size());
    for (const uint32_t use : next.uses) {
      const auto known = std::find(found.begin(), found.end(), use);
      identity.push_back(static_cast<uint64_t>(known - found.begin()));
      if (known == found.end()) found.push_back(use);
    }
  }
  return identity;
}

}  // namespace language
