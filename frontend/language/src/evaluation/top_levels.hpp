// The top levels of files. Each call of a used file's function or module has its top level
// evaluated anew, as far as that can be observed (LANGUAGE.md, "Scopes and calls").
#pragma once

#include <cstdint>
#include <vector>

#include "code/compiler.hpp"
#include "evaluation/call_stack.hpp"

namespace language {

class TopLevels {
 public:
  TopLevels(Compiler& compiler, CallStack& stack)
      : compiler_(compiler), stack_(stack), kept_(compiler.program().units.size()) {}

  /// Begins the assignments of the main file's top level.
  void begin_main();
  /// The scope that they have filled; null: they have not begun.
  HeapScope* main_scope() const { return main_scope_; }

  /// Keeps the scope of a used file's top level for a call, at once or after its assignments.
  void enter(uint32_t unit);
  /// Ends the assignments of a top level. Returns true after those of the main file.
  bool end();

 private:
  /// A top level that can be used again while the `$` names that it read have the same values.
  struct Kept {
    HeapScope* scope = nullptr;  // counted; null: none is kept
    NamedValues reads;
    NamedValues bindings;  // `$` names that it binds, in order
  };

  bool reuse(uint32_t unit);
  void keep(HeapScope* scope);

  Compiler& compiler_;
  CallStack& stack_;
  HeapScope* main_scope_ = nullptr;
  std::vector<Kept> kept_;  // by unit
};

}  // namespace language
