// The parameters of a function or module, and what the arguments of a call are assigned to.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/dialect.hpp"
#include "base/name_list.hpp"
#include "base/name_table.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// What an argument or a default is assigned to.
struct Target {
  Name name;
  uint32_t slot;    // counted from the first parameter; unused for `$` names
  bool is_dynamic;  // a `$` name, which is bound instead
};

/// Parameters in their slots. A name that is listed twice has one slot, and the last default wins.
struct ParameterList {
  std::vector<Target> targets;              // of each parameter, in order
  std::vector<const Expression*> defaults;  // per slot; null: none
  NameList slot_names;                      // parameters first, then what calls pass undeclared
  uint32_t declared_slots = 0;

  ParameterList() = default;
  ParameterList(std::span<const Parameter> parameters, const NameTable& names,
                const Dialect& dialect);
  /// Parameters of a builtin module, which have no defaults.
  ParameterList(std::span<const Name> parameters, const NameTable& names);
  /// Returns the slot of a name that a call passes, which gets one if it has none. `$` names have
  /// no slot unless the callee binds them.
  Target target_of(Name name, const NameTable& names);
  bool declares(Name name) const;

 private:
  bool binds_dynamic_ = false;  // whether the callee does
};

/// Returns whether a name is looked up dynamically: `$children` is the one `$` name that is not.
bool is_dynamic_name(Name name, const NameTable& names);

/// Returns whether one of the arguments is named by a name that is looked up dynamically.
bool names_dynamic(std::span<const Argument> arguments, const NameTable& names);

struct ArgumentWarning {
  std::string text;
  Place place;
  bool is_resolution;  // one that --check-parameters=false silences
};

/// How the arguments of a call are assigned to parameters.
struct ArgumentPlan {
  struct Step {
    uint32_t argument;
    Target target;
    bool is_dropped = false;  // it is evaluated, and counts for nothing
    /// Returns whether it gives one of the first slots, of so many, a value.
    bool is_for(uint32_t slots) const {
      return !is_dropped && !target.is_dynamic && target.slot < slots;
    }
  };
  std::vector<Step> steps;  // in the order of evaluation
  std::vector<ArgumentWarning> warnings;
};

/// Resolves arguments as OpenSCAD does (LANGUAGE.md, "Scopes and calls"); `call` is the place of
/// the call. Where unnamed arguments fill free parameters, `taken` is none of these.
ArgumentPlan plan_arguments(std::span<const Argument> arguments, ParameterList& parameters,
                            size_t positional, Place call, const NameTable& names,
                            const Dialect& dialect, Name taken = kNoName);

}  // namespace language
