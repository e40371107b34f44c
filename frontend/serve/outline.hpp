// What a text defines and refers to, also where it is broken.
//
// The parser of frontend/language ends at the first syntax error, and drops what evaluation does
// not need: comments, calls with `*`, definitions that others replace, the ends of scopes. An
// editor needs them all the time. So this reads the same grammar (LANGUAGE.md) in one pass over the
// tokens, and goes on at the next statement where it does not fit. Of a text without errors it
// finds what the parser finds, which a test holds it against.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "text.hpp"
#include "tokens.hpp"

namespace serve {

constexpr uint32_t kNone = 0xFFFFFFFFu;

/// Names of one space do not meet those of another. A call in an expression looks among variables
/// first.
enum class NameSpace : uint8_t { kVariables, kFunctions, kModules };

enum class SymbolKind : uint8_t { kVariable, kParameter, kFunction, kModule };

struct Definition {
  SymbolKind kind;
  std::string_view name;  // in the outline's text, as all names
  Span name_span;
  Span span;               // the whole definition
  Span value;              // of a variable or a default; of a function, its body. Empty: none
  uint32_t scope;          // in which it is visible
  uint32_t inner = kNone;  // of a module, a function or a function literal: of its parameters
  std::vector<uint32_t> parameters{};  // their definitions
  uint32_t token = 0;                  // its first
  bool has_value = false;

  NameSpace name_space() const {
    if (kind == SymbolKind::kModule) return NameSpace::kModules;
    return kind == SymbolKind::kFunction ? NameSpace::kFunctions : NameSpace::kVariables;
  }
};

enum class ReferenceKind : uint8_t {
  kVariable,
  kCall,      // in an expression
  kModule,    // a module's call
  kArgument,  // the name of an argument
};

struct Reference {
  ReferenceKind kind;
  std::string_view name;
  Span span;
  uint32_t scope;
  /// The assignment in whose value it is evaluated, before which the variable has another meaning.
  uint32_t value_of = kNone;
  uint32_t callee = kNone;  // of an argument: the reference that is called; kNone: a value
};

struct Scope {
  Span span;
  uint32_t parent;  // of the file: kNone
};

/// An `include` or `use`.
struct FileName {
  bool is_use;
  Span path;  // without the brackets
};

struct Outline {
  TextPointer text;
  std::vector<Token> tokens;
  std::vector<Scope> scopes;  // the first one is the file; others are behind those around them
  std::vector<Definition> definitions;
  std::vector<Reference> references;
  std::vector<FileName> files;
  std::unordered_map<std::string_view, std::vector<uint32_t>> by_name;  // definitions, in order

  /// Returns the innermost scope around an offset.
  uint32_t scope_at(std::size_t offset) const;
  /// Finds what a name means in a scope and those around it. `reference` tells where it is read,
  /// and may be null. Returns the last of equal definitions; kNone: nothing in this text.
  uint32_t find(NameSpace space, std::string_view name, uint32_t scope,
                const Reference* reference) const;
  /// Returns what a reference means in this text, or kNone.
  uint32_t resolve(const Reference& reference) const;
  /// Returns whether both define the same variable, function or module.
  bool are_same(uint32_t a, uint32_t b) const;
  /// Returns the reference, or the definition, whose name touches an offset; kNone: there is none.
  uint32_t reference_at(std::size_t offset) const;
  uint32_t definition_at(std::size_t offset) const;
  /// Returns the text of the comments that end directly above a definition, without their marks.
  std::string comment_of(const Definition& definition) const;
};

Outline outline_of(TextPointer text);

/// A call around the cursor.
struct OpenCall {
  Reference callee;  // its name is empty where a value is called
  uint32_t argument = 0;
  std::string_view argument_name{};
};

/// What may stand at a place of a text.
struct Context {
  bool is_statement = false;       // a statement begins here
  bool begins_argument = false;    // an argument of the innermost call does
  bool is_new_name = false;        // the name of a definition, which is being typed
  bool is_member = false;          // behind a dot
  bool is_text = false;            // within a comment, a string or a number
  std::vector<OpenCall> calls{};   // the innermost last
  const FileName* file = nullptr;  // within the path of an `include` or `use`
};

Context context_at(const Outline& outline, std::size_t offset);

}  // namespace serve
