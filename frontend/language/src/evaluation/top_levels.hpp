// The top levels of files. Each call of a used file's function or module has its top level
// evaluated anew, as far as that can be observed (LANGUAGE.md, "Scopes and calls"); a cache of them
// lasts beyond the evaluation.
#pragma once

#include <cstdint>
#include <vector>

#include "code/compiler.hpp"
#include "evaluation/call_stack.hpp"
#include "evaluation/evaluation_cache.hpp"

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

  /// Uses top levels that earlier evaluations have kept. They must not change.
  void use(const KeptTops& tops) { earlier_ = &tops; }
  /// Keeps the top levels that were entered for later evaluations.
  void save(KeptTops& tops);

 private:
  /// A top level that can be used again while the `$` names that it read have the same values.
  struct Kept {
    HeapScope* scope = nullptr;  // counted; null: none is kept
    NamedValues reads;
    NamedValues bindings;       // `$` names that it binds, in order
    bool is_looked_up = false;  // among those of earlier evaluations
    bool is_loaded = false;     // from there
  };

  const std::string& path_of(uint32_t unit) const;
  bool reuse(uint32_t unit);
  void keep(HeapScope* scope);
  void load(uint32_t unit);
  void save(uint32_t unit, KeptTops& tops);

  Compiler& compiler_;
  CallStack& stack_;
  HeapScope* main_scope_ = nullptr;
  std::vector<Kept> kept_;             // by unit
  const KeptTops* earlier_ = nullptr;  // null: none
};

}  // namespace language
