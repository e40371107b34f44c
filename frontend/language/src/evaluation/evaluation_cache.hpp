// What an EvaluationCache holds: top levels of used files, and calls of modules with the nodes that
// they have made.
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
#include "language/node_tree.hpp"
#include "language/source_files.hpp"
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

/// What the nodes that a call has made follow from, if evaluating it anew could not be observed
/// otherwise.
struct KeptCall {
  uint64_t hash;  // of the module and the arguments
  uint64_t module;
  NamedValues arguments;              // as they are bound, those that are set
  NamedValues reads;                  // of `$` names; unset: not bound
  std::vector<uint32_t> definitions;  // of the main unit, whose code ran
  std::vector<uint32_t> variables;    // of its top level, that this code can read: their slots
  uint64_t work;                      // the evaluation's steps
  size_t depth;                       // of the stack of calls
};

/// Where in a tree the nodes of a call stand: those within its group.
struct KeptNodes {
  std::shared_ptr<const KeptCall> call;
  uint32_t first, end;
  /// How many of the calls before it in the list are within it. A list of calls is in the order in
  /// which they ended.
  uint32_t within;
};

/// The bytes of a definition at the main unit's top level, where they are all that it consists of.
struct DefinitionText {
  FileId file = kNoFile;  // kNoFile: an include stands in it
  uint32_t begin = 0, end = 0;
};

/// The calls of an evaluation, and what they are compared with later.
struct KeptCalls {
  std::vector<KeptNodes> calls;
  std::shared_ptr<const NodeTree> tree;      // null: nothing is kept
  std::shared_ptr<const SourceFiles> files;  // that the tree's places refer to
  std::vector<uint64_t> structure;
  std::vector<DefinitionText> definitions;
  std::unordered_map<uint32_t, Value> variables;  // by slot; they share nothing with any evaluation
};

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
  KeptCalls calls;

 private:
  size_t first_size_ = 0;  // of the sources after the first evaluation; 0: there was none
  Checks checks_;
};

}  // namespace language
