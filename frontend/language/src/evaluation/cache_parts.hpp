// What an EvaluationCache holds.
#pragma once

#include <memory>

#include "evaluation/kept_calls.hpp"
#include "evaluation/kept_tops.hpp"
#include "language/evaluation_cache.hpp"
#include "syntax/kept_sources.hpp"

namespace language {

struct EvaluationCache::Parts {
  /// Options on which it depends what an evaluation says.
  struct Checks {
    bool parameters = true, ranges = false, warnings_are_errors = false;
    bool operator==(const Checks&) const = default;
  };
  /// To be called when an evaluation begins. Forgets all if names and paths that are no longer used
  /// have become many, and values if they were made with other options.
  void begin(const Checks& checks);

  std::shared_ptr<KeptSources> sources = std::make_shared<KeptSources>();
  KeptTops tops;
  KeptCalls calls;

 private:
  size_t first_size_ = 0;  // of the sources after the first evaluation; 0: there was none
  Checks checks_;
};

}  // namespace language
