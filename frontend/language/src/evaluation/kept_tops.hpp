// Top levels of used files, kept between evaluations.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/name_table.hpp"
#include "language/value.hpp"
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

}  // namespace language
