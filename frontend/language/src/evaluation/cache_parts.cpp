#include "evaluation/cache_parts.hpp"

namespace language {

EvaluationCache::EvaluationCache() : parts_(std::make_unique<Parts>()) {}
EvaluationCache::~EvaluationCache() = default;

void EvaluationCache::Parts::begin(const Checks& checks) {
  constexpr size_t kMostUnused = 1000;
  constexpr size_t kBuiltins = 100;  // names that each evaluation knows, at least
  if (first_size_ == 0 && sources->size() > kBuiltins) first_size_ = sources->size();
  if (first_size_ != 0 && sources->size() > 2 * first_size_ + kMostUnused) {
    sources = std::make_shared<KeptSources>();
    first_size_ = 0;
    tops.clear();
    calls = {};
  }
  if (checks == checks_) return;
  tops.clear();
  calls = {};
  checks_ = checks;
}

}  // namespace language
