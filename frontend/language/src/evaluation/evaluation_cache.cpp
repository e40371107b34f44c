#include "evaluation/evaluation_cache.hpp"

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

EvaluationCache::EvaluationCache() : parts_(std::make_unique<Parts>()) {}
EvaluationCache::~EvaluationCache() = default;

void EvaluationCache::Parts::begin(const Checks& checks) {
  constexpr size_t kMostUnused = 1000;
  constexpr size_t kBuiltins = 100;  // names that each evaluation knows, at least
  if (first_size_ == 0 && sources->size() > kBuiltins) first_size_ = sources->size();
  const bool has_many_unused = first_size_ != 0 && sources->size() > 2 * first_size_ + kMostUnused;
  if (has_many_unused || checks.language != checks_.language) {
    sources = std::make_shared<KeptSources>();
    first_size_ = 0;
    tops.clear();
  }
  if (checks == checks_) return;
  tops.clear();
  checks_ = checks;
}

}  // namespace language
