// Where the variables, functions and modules of a scope are found (LANGUAGE.md, "Scopes and
// calls").
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/name_list.hpp"

namespace language {

struct FunctionDefinition;
struct FunctionEntry;
struct ModuleDefinition;
struct ModuleEntry;
struct Code;

/// The functions or the modules that a scope defines. Most of a library's are never called, so
/// their entries are made when they are first looked for.
template <typename Definition, typename Entry>
struct Defined {
  const Definition* written;
  mutable Entry* entry = nullptr;  // null: not made yet
};
template <typename Definition, typename Entry>
using DefinedNames = std::unordered_map<Name, Defined<Definition, Entry>>;

struct ScopeVariable {
  Name name;
  uint32_t slot;  // in the frame, or in the heap scope
  /// Whether code of the scope's own Code finds it set: its assignment has been compiled.
  bool is_set = false;
  /// Whether code elsewhere does: a parameter that every call sets.
  bool is_always_set = false;
  /// Whether it may be unset even later: what only some calls pass, or only later rounds of a
  /// C-style for assign.
  bool is_optional = false;
};

/// A scope as the compiler knows it. One whose variables other code can refer to (a function
/// literal, a nested definition, a child block) is a scope in the heap at run time; the others are
/// slots of their frame.
class ScopeLayout {
 public:
  ScopeLayout(const ScopeLayout* around, uint32_t unit_number, const Code* opener, bool in_heap)
      : parent(around),
        unit(unit_number),
        code(opener),
        is_in_heap(in_heap),
        heap_depth((around ? around->heap_depth : 0) + (in_heap ? 1 : 0)) {}

  const ScopeLayout* const parent;  // null for the top level of a file
  const uint32_t unit;
  const Code* const code;  // whose instructions open it
  const bool is_in_heap;
  const uint32_t heap_depth;  // number of heap scopes from the file's top level to here

  /// Adds a variable, at the end of what has the same name.
  ScopeVariable& add(Name name, uint32_t slot) {
    return variables_.emplace_back(ScopeVariable{name, slot});
  }
  /// Adds a variable of a heap scope in its next slot, unless it is there.
  ScopeVariable& declare(Name name) {
    ScopeVariable* const found = find(name);
    return found ? *found : add(name, size());
  }
  const ScopeVariable* find(Name name) const {
    const uint32_t position =
        index_.find(name, variables_.size(), [&](uint32_t i) { return variables_[i].name; });
    return position == NameIndex::kNone ? nullptr : &variables_[position];
  }
  ScopeVariable* find(Name name) {
    return const_cast<ScopeVariable*>(static_cast<const ScopeLayout*>(this)->find(name));
  }
  uint32_t size() const { return static_cast<uint32_t>(variables_.size()); }
  const std::vector<ScopeVariable>& variables() const { return variables_; }

  DefinedNames<FunctionDefinition, FunctionEntry> functions;
  DefinedNames<ModuleDefinition, ModuleEntry> modules;

 private:
  std::vector<ScopeVariable> variables_;
  mutable NameIndex index_;
};

}  // namespace language
