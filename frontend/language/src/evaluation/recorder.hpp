// Records what those parts of an evaluation depend on that may be kept: the top levels of used
// files, and calls of modules.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "code/code.hpp"
#include "evaluation/dependency_log.hpp"
#include "evaluation/dynamic_names.hpp"
#include "evaluation/evaluation_cache.hpp"
#include "evaluation/limits.hpp"
#include "functions/builtin_functions.hpp"
#include "syntax/program.hpp"

namespace language {

constexpr uint32_t kNoUnit = 0xFFFFFFFFu;

/// The evaluation of a used file's top level, or of a module's call. What it depends on stands in
/// the DependencyLog.
struct Record {
  uint32_t unit;      // whose top level it is; kNoUnit: a call of a module
  uint32_t trail;     // of `$` names, when it began
  uint64_t messages;  // that had been said by then
  size_t finds;       // of files until then
  uint64_t steps;     // until then
  size_t modules;     // that run around it
  /// It has called no rands(), no parent_module() of those around it, and met nothing that only the
  /// first call of a run does. A top level has made no function value.
  bool is_pure = true;
  // What follows is known of a call only.
  uint64_t hash = 0;        // of the module and its arguments
  size_t frames = 0;        // whose number is that of its frame
  uint32_t first_node = 0;  // of the tree
  uint32_t first_call = 0;  // of those that are kept
};

/// The records of the parts that are being evaluated, from outside in.
class Recorder {
 public:
  Recorder(const Program& program, const FunctionEnvironment& environment,
           const DynamicNames& dynamic, const StepCount& steps);

  bool is_recording() const { return !records_.empty(); }
  const Record& innermost() const { return records_.back(); }
  Record& begin(uint32_t unit);
  /// Ends the innermost part. The one around it depends on the same, but for the `$` names that it
  /// has bound itself.
  void end();

  /// Each of the following notes something that all parts depend on.
  void note_read(Name name) {
    if (is_recording()) note(name_number(name), name);
  }
  void note_code(const Code& code) {
    if (code.noted_by != record_ && record_ != 0) note_new_code(code);
  }
  void note_definition(uint32_t number) { dependencies_.note(number); }
  void note_variable(uint32_t slot) { dependencies_.note(definitions_ + slot); }
  /// … on what has happened before in the run.
  void note_history();
  /// … on a builtin function's call: its result may differ from call to call, or with a file.
  void note_builtin(const BuiltinFunction& function, std::span<const Value> arguments) {
    if (is_recording()) note_result(function, arguments);
  }
  /// A function value has been made, which no top level can keep.
  void note_closure();

  // Of the innermost part:

  /// Returns whether evaluating it anew could not be observed.
  bool is_repeatable() const;
  /// Returns the `$` names that others had bound, with their values when it began.
  NamedValues reads() const;
  /// Appends the definitions of the main unit whose code ran, and the slots of the variables of its
  /// top level that this code can read.
  void append_sources(std::vector<uint32_t>& definitions, std::vector<uint32_t>& variables) const;

 private:
  uint32_t name_number(Name name) const { return definitions_ + variables_ + name; }
  void note(uint32_t number, Name name);
  void note_new_code(const Code& code);
  void note_result(const BuiltinFunction& function, std::span<const Value> arguments);
  void note_parent(std::span<const Value> arguments);

  const FunctionEnvironment& environment_;
  const DynamicNames& dynamic_;
  const StepCount& steps_;
  std::vector<Record> records_;
  const uint32_t definitions_, variables_;  // of the main unit's top level
  DependencyLog dependencies_;              // of these: definitions, then variables, then `$` names
  uint64_t record_ = 0;  // number of the innermost record since its last change; 0: none
  uint64_t records_made_ = 0;
};

}  // namespace language
