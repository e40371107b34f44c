// What OpenSCAD's own modules, functions, variables and words are for.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "language/language_version.hpp"

namespace serve {

enum class BuiltinKind : uint8_t { kModule, kFunction, kVariable, kWord };

struct Builtin {
  BuiltinKind kind;
  std::string_view name;
  std::string_view signatures;  // one a line; of a variable, its default
  std::string_view about;
  bool is_new = false;  // only the language of 2026 has it
  bool is_deprecated = false;
};

/// All of them, for a version of the language.
std::span<const Builtin> builtins(language::LanguageVersion version);
/// Returns one, or null.
const Builtin* find_builtin(language::LanguageVersion version, BuiltinKind kind,
                            std::string_view name);

}  // namespace serve
