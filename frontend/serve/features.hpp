// What an editor asks of a text. None of it knows the protocol: places are bytes of sources.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "builtins.hpp"
#include "sources.hpp"

namespace serve {

/// What a feature looks at: a place in an open document.
struct Query {
  Sources& sources;
  SourcePointer source;
  std::size_t offset;
  language::LanguageVersion version;
};

/// The kind of something that is listed.
enum class ItemKind : uint8_t { kModule, kFunction, kVariable, kParameter, kWord, kFile, kFolder };

// completion.cpp

struct Completion {
  std::string label;
  ItemKind kind;
  std::string text;    // that is put in place of the span
  std::string detail;  // a signature
  std::string about;
  bool is_deprecated = false;
};

struct Completions {
  Span replaced;  // from the begin of the word to the cursor
  std::vector<Completion> list;
};

Completions completions(const Query& query);

struct Signature {
  std::string label;
  std::vector<Span> parameters;  // in the label
  std::string about;
};

struct SignatureHelp {
  std::vector<Signature> signatures;  // never empty
  uint32_t active = 0;
  std::optional<uint32_t> active_parameter;
};

std::optional<SignatureHelp> signature_help(const Query& query);

/// Returns a definition as the design spells it, without its body and in one line.
std::string signature_of(const Found& found);

// navigation.cpp

struct Hover {
  Span span;
  std::string code;   // a signature
  std::string about;  // its documentation; may be empty
};

/// `values` are those of the document's top level.
std::optional<Hover> hover(const Query& query,
                           const std::map<std::string, std::string, std::less<>>& values);

/// Returns where the name at the offset is defined, or the file that is named there. The span of a
/// file is empty.
std::vector<PlaceInSource> definitions(const Query& query);

std::vector<PlaceInSource> references(const Query& query, bool with_definitions);

/// What a rename would replace.
struct Renaming {
  Span span;  // the name at the offset
  std::vector<PlaceInSource> places;
};

/// Returns what renaming would replace; a text that says why there is nothing to rename.
std::variant<Renaming, std::string> renaming(const Query& query);
/// Returns why a name cannot be the new one; empty: it can.
std::string problem_of_name(const Query& query, const Renaming& renaming, std::string_view name);

// structure.cpp

struct Symbol {
  std::string name;
  std::string detail;
  ItemKind kind;
  Span span, name_span;
  std::vector<Symbol> children;
};

std::vector<Symbol> symbols(const Source& source);

struct Fold {
  enum class Kind : uint8_t { kRegion, kComment, kImports };
  uint32_t first_line, last_line;
  Kind kind;
};

std::vector<Fold> folds(const Source& source);

/// A colour that stands in a call of color().
struct ColorPlace {
  Span span;
  std::array<double, 4> color;
};

std::vector<ColorPlace> colors(const Source& source);
/// Returns how a colour may be spelled in place of what stands at a span.
std::vector<std::string> color_texts(const std::array<double, 4>& color, std::string_view now);

}  // namespace serve
