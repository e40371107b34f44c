#include "language/evaluation_cache.hpp"

#include "syntax/kept_sources.hpp"

namespace language {

EvaluationCache::EvaluationCache() : sources_(std::make_shared<KeptSources>()) {}

void EvaluationCache::begin(LanguageVersion language) {
  constexpr size_t kMostUnused = 1000;
  constexpr size_t kBuiltins = 100;  // names that each evaluation knows, at least
  if (first_size_ == 0 && sources_->size() > kBuiltins) first_size_ = sources_->size();
  const bool has_many_unused = first_size_ != 0 && sources_->size() > 2 * first_size_ + kMostUnused;
  if (!has_many_unused && language == language_) return;
  sources_ = std::make_shared<KeptSources>();
  first_size_ = 0;
  language_ = language;
}

}  // namespace language
