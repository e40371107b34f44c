// What an EvaluationCache holds: files, and top levels of used ones.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/name_table.hpp"
#include "language/evaluation_cache.hpp"
#include "language/language_version.hpp"
#include "language/value.hpp"
#include "syntax/kept_sources.hpp"
#include "syntax/program.hpp"

namespace language {

using NamedValues = std::vector<std::pair<Name, Value>>;

/// The result of a top level whose evaluation anew could not be observed, as long as the `$` names
/// that it read have the same values.
struct KeptTop {
  /// What the result depends on otherwise: see unit_identity().
  std::vector<uint64_t> identity;
  std::vector<Value> variables;  // of its scope; they share nothing with any evaluation
  NamedValues reads;             // unset: not bound
  NamedValues bindings;          // `$` names that it binds, in order
};

/// Returns numbers that are the same for two units only if the texts of both are the same, and
/// those of all units that they use.
std::vector<uint64_t> unit_identity(const Program& program, uint32_t unit);

/// By the path of the file.
using KeptTops = std::unordered_map<std::string, KeptTop>;

struct EvaluationCache::Parts {
  /// Options on which it depends what an evaluation says.
  struct Checks {
    LanguageVersion language = LanguageVersion::k2021;
    bool parameters = true, ranges = false, warnings_are_errors = false;
    bool operator==(const Checks&) const = default;
  };
  /// To be called when an evaluation begins. Forgets all if names and paths that are no longer used
  /// have become many, and values if they were made with other options.
  void begin(const Checks& checks);

  std::shared_ptr<KeptSources> sources = std::make_shared<KeptSources>();
  KeptTops tops;

 private:
  size_t first_size_ = 0;  // of the sources after the first evaluation; 0: there was none
  Checks checks_;
};

}  // namespace language
