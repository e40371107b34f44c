// Records what the top levels of used files depend on: their results may be used again
// (top_levels.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "evaluation/dependency_log.hpp"
#include "evaluation/dynamic_names.hpp"
#include "functions/builtin_functions.hpp"

namespace language {

/// The evaluation of a used file's top level. The `$` names that it reads stand in the
/// DependencyLog.
struct Record {
  uint32_t unit;      // whose top level it is
  uint32_t trail;     // of `$` names, when it began
  uint64_t messages;  // that had been said by then
  size_t finds;       // of files until then
  /// It has called no rands() and no parent_module(), made no function value, and met nothing that
  /// only the first call of a run does.
  bool is_pure = true;
};

/// The records of the top levels that are being evaluated, from outside in.
class Recorder {
 public:
  /// `names` is how many names the program has.
  Recorder(size_t names, const FunctionEnvironment& environment, const DynamicNames& dynamic)
      : environment_(environment), dynamic_(dynamic), dependencies_(names) {}

  const Record& innermost() const { return records_.back(); }
  void begin(uint32_t unit);
  /// Ends the innermost one. The one around it depends on the same, but for the `$` names that it
  /// has bound itself.
  void end();

  // Each of the following notes something that all of them depend on.

  /// The value of a `$` name.
  void note_read(Name name) {
    if (!records_.empty()) note(name);
  }
  /// What has happened before in the run, or what cannot be kept.
  void note_history();
  /// A builtin function's call: its result may differ from call to call, or with a file.
  void note_builtin(const BuiltinFunction& function) {
    if (!records_.empty()) note_result(function);
  }

  // These tell of the innermost one.

  /// Returns whether evaluating it anew could not be observed.
  bool is_repeatable() const;
  /// Returns the `$` names that others had bound, with their values when it began.
  NamedValues reads() const;

 private:
  void note(Name name);
  void note_result(const BuiltinFunction& function);

  const FunctionEnvironment& environment_;
  const DynamicNames& dynamic_;
  std::vector<Record> records_;
  DependencyLog dependencies_;  // of `$` names
};

}  // namespace language
