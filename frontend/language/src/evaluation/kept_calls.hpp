// Calls of modules, kept between evaluations with the nodes that they have made.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "evaluation/kept_tops.hpp"
#include "language/node_tree.hpp"
#include "language/source_files.hpp"
#include "syntax/program.hpp"

namespace language {

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

/// Returns the functions of a program's main unit, then the modules, in their order.
std::vector<DefinitionText> definition_texts(const Program& program);

/// The calls of an evaluation, and what they are compared with later.
struct KeptCalls {
  std::vector<KeptNodes> calls;
  std::shared_ptr<const NodeTree> tree;      // null: nothing is kept
  std::shared_ptr<const SourceFiles> files;  // that the tree's places refer to
  std::vector<uint64_t> structure;
  std::vector<DefinitionText> definitions;
  std::unordered_map<uint32_t, Value> variables;  // by slot; they share nothing with any evaluation
};

/// Returns numbers that are the same for two programs only if a name within the same definition has
/// the same meaning in both: if their top levels define the same names, and they use the same
/// files.
std::vector<uint64_t> program_structure(const Program& program);

/// The calls of an earlier evaluation, for a later one.
class CallIndex {
 public:
  /// `now` are the definitions of the later evaluation's program, in `files`. Both must last.
  CallIndex(const KeptCalls& kept, const std::vector<DefinitionText>& now,
            const SourceFiles& files);

  const KeptCalls& kept() const { return kept_; }
  /// Returns the position of a call that `is_same` accepts among those with a hash. Calls are
  /// mostly made in the order in which they were made before.
  template <typename Predicate>
  std::optional<size_t> find(uint64_t hash, Predicate is_same) {
    const auto found = heads_.find(hash);
    if (found == heads_.end()) return std::nullopt;
    Head& head = found->second;
    size_t position = head.next;
    for (int tries = 0; tries < kMostTries; ++tries) {
      const size_t next = next_[position] == kNone ? head.first : next_[position];
      if (is_same(*kept_.calls[position].call)) {
        head.next = next;
        return position;
      }
      position = next;
      if (position == head.next) break;
    }
    return std::nullopt;
  }
  bool is_same_definition(uint32_t number) const { return is_same_definition_[number]; }
  /// Returns whether a variable of the top level has the value that it had.
  bool is_same_variable(uint32_t slot, const Value& value);
  /// Returns a place, which was in one of some definitions, or in a file that has not changed, as
  /// it is now.
  Place moved(Place place, const std::vector<uint32_t>& definitions) const;

 private:
  static constexpr int kMostTries = 8;
  static constexpr size_t kNone = ~size_t{0};
  struct Head {
    size_t first, last, next;
  };
  enum class Comparison : uint8_t { kNone, kSame, kOther };

  const KeptCalls& kept_;
  std::unordered_map<uint64_t, Head> heads_;  // by hash
  std::vector<size_t> next_;                  // of the same hash; kNone: the last
  const std::vector<DefinitionText>& now_;
  std::vector<bool> is_same_definition_;
  std::vector<Comparison> variables_;  // by slot
  bool has_moved_ = false;             // some definition
};

}  // namespace language
