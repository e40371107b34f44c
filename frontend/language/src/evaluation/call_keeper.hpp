// Calls of modules whose nodes follow from what they followed from in an earlier evaluation: they
// are copied (language/evaluation_cache.hpp).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "evaluation/call_stack.hpp"
#include "evaluation/evaluation_cache.hpp"
#include "evaluation/top_levels.hpp"

namespace language {

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

/// Owns the calls of an evaluation that a later one can use, and knows those of an earlier one.
class CallKeeper {
 public:
  CallKeeper(const Program& program, NodeTree& tree, CallStack& stack, const TopLevels& tops)
      : program_(program), tree_(tree), stack_(stack), tops_(tops) {}

  /// Begins to keep calls, and uses those of an earlier evaluation, which must not change.
  void use(const KeptCalls& earlier);
  /// Returns the calls that were kept, without tree and files.
  KeptCalls take() { return std::move(calls_); }

  /// Takes note of a call whose node is open, and whose arguments are on top of the stack. Returns
  /// true if its nodes have been copied, so that it need not happen.
  bool begin(const CallSite& site, const HeapScope* scope);
  /// Ends the innermost call of the stack, if its nodes may be kept. Its `$` names are no longer
  /// bound.
  void end(const ModuleEntry& module);

 private:
  bool may_keep(const CallSite& site, const HeapScope* scope) const;
  bool is_same(const KeptCall& call, const ModuleEntry& module, std::span<const Value> arguments);
  bool reuse(size_t position);
  void note(const KeptCall& call);
  void keep(const Record& record, const ModuleEntry& module);
  bool keep_variable(uint32_t slot);

  const Program& program_;
  NodeTree& tree_;
  CallStack& stack_;
  const TopLevels& tops_;
  bool is_on_ = false;
  std::optional<CallIndex> earlier_;  // that can be used
  KeptCalls calls_;
};

}  // namespace language
