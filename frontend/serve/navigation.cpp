// Hover, definitions, references and renaming.
#include <algorithm>

#include "features.hpp"
#include "syntax/characters.hpp"

namespace serve {
namespace {

/// Returns the word at the offset, which may be reserved; nothing: there is none.
std::optional<Span> word_at(const Outline& outline, std::size_t offset) {
  for (std::size_t i = token_behind(outline.tokens, offset > 0 ? offset - 1 : 0);
       i < outline.tokens.size() && outline.tokens[i].span.begin <= offset; ++i) {
    const Token& token = outline.tokens[i];
    if (token.kind == TokenKind::kWord && token.span.touches(offset)) return token.span;
  }
  return std::nullopt;
}

const FileName* file_at(const Outline& outline, std::size_t offset) {
  const auto found = std::ranges::find_if(
      outline.files, [&](const FileName& file) { return file.path.touches(offset); });
  return found == outline.files.end() ? nullptr : &*found;
}

/// Returns the builtin that the word at the offset names; null: none.
const Builtin* builtin_at(const Query& query, Span word) {
  const Outline& outline = query.source->outline;
  const std::string_view name = outline.text->at(word);
  const auto find = [&](BuiltinKind kind) { return find_builtin(query.version, kind, name); };
  const uint32_t reference = outline.reference_at(query.offset);
  if (reference == kNone) return find(BuiltinKind::kWord);
  switch (outline.references[reference].kind) {
    case ReferenceKind::kModule:
      return find(BuiltinKind::kModule);
    case ReferenceKind::kCall:
      if (const Builtin* const function = find(BuiltinKind::kFunction)) return function;
      return find(BuiltinKind::kWord);
    case ReferenceKind::kVariable:
    case ReferenceKind::kArgument:
      break;
  }
  return find(BuiltinKind::kVariable);
}

const char* word_of(SymbolKind kind) {
  return kind == SymbolKind::kModule ? "module " : kind == SymbolKind::kFunction ? "function " : "";
}

/// Returns all places of the name at the offset; nothing where no text defines it.
std::optional<std::vector<PlaceInSource>> occurrences_at(const Query& query) {
  const Outline& outline = query.source->outline;
  const auto word = word_at(outline, query.offset);
  const std::string_view name = word ? outline.text->at(*word) : "";
  if (name.starts_with('$')) return query.sources.dynamic_occurrences(name);
  const auto found = query.sources.meaning_at(query.source, query.offset);
  if (!found) return std::nullopt;
  return query.sources.occurrences(*found);
}

}  // namespace

std::optional<Hover> hover(const Query& query,
                           const std::map<std::string, std::string, std::less<>>& values) {
  const Outline& outline = query.source->outline;
  const auto word = word_at(outline, query.offset);
  if (!word) return std::nullopt;
  const std::string_view name = outline.text->at(*word);
  if (const auto found = query.sources.meaning_at(query.source, query.offset)) {
    const Definition& definition = **found;
    Hover result{*word, word_of(definition.kind) + signature_of(*found),
                 found->source->outline.comment_of(definition)};
    const auto value = values.find(name);
    const bool is_constant = definition.scope == 0 && definition.kind == SymbolKind::kVariable;
    if (is_constant && value != values.end() && !definition.parameters.size()) {
      const std::string same = std::string(name) + " = " + value->second;
      if (same != result.code) result.code += "\n// = " + value->second;
    }
    return result;
  }
  const Builtin* const builtin = builtin_at(query, *word);
  if (!builtin) return std::nullopt;
  std::string code(builtin->signatures);
  if (builtin->kind == BuiltinKind::kVariable)
    code = std::string(name) + (code.empty() ? "" : " = " + code);
  return Hover{*word, std::move(code), std::string(builtin->about)};
}

std::vector<PlaceInSource> definitions(const Query& query) {
  if (const FileName* const file = file_at(query.source->outline, query.offset)) {
    const std::string_view name = query.source->outline.text->at(file->path);
    const std::string path = query.sources.find_file(*query.source, name);
    const SourcePointer source = path.empty() ? nullptr : query.sources.of_file(path);
    if (source) return {{source, {0, 0}}};
    return {};
  }
  const auto found = query.sources.meaning_at(query.source, query.offset);
  if (!found) return {};
  return {{found->source, (*found)->name_span}};
}

std::vector<PlaceInSource> references(const Query& query, bool with_definitions) {
  std::vector<PlaceInSource> places = occurrences_at(query).value_or(std::vector<PlaceInSource>());
  if (!with_definitions) {
    std::erase_if(places, [&](const PlaceInSource& place) {
      const auto& made = place.source->outline.definitions;
      return std::ranges::find(made, place.span, &Definition::name_span) != made.end();
    });
  }
  return places;
}

std::variant<Renaming, std::string> renaming(const Query& query) {
  const Outline& outline = query.source->outline;
  const auto word = word_at(outline, query.offset);
  if (!word) return "there is no name here";
  const std::string name(outline.text->at(*word));
  if (find_builtin(query.version, BuiltinKind::kVariable, name) && name.starts_with('$'))
    return name + " is OpenSCAD's own";
  auto places = occurrences_at(query);
  if (!places)
    return builtin_at(query, *word) ? name + " is OpenSCAD's own" : "nothing here defines " + name;
  Renaming result{*word, std::move(*places)};
  for (const PlaceInSource& place : result.places) {
    if (!query.sources.is_editable(*place.source))
      return name + " stands in " + place.source->path + ", which is no file of the open folders";
  }
  return result;
}

std::string problem_of_name(const Query& query, const Renaming& renaming, std::string_view name) {
  const std::string quoted = "\"" + std::string(name) + "\"";
  const bool was_dynamic = query.source->outline.text->at(renaming.span).starts_with('$');
  std::string_view letters = name;
  if (letters.starts_with('$')) letters.remove_prefix(1);
  if (letters.empty() || !std::ranges::all_of(letters, language::is_word) ||
      language::is_digit(letters.front()) || is_reserved(name))
    return quoted + " is no name";
  if (name.starts_with('$') != was_dynamic)
    return was_dynamic ? quoted + " lacks the $ that makes the name special"
                       : quoted + " has a $, which would make the name special";
  for (const PlaceInSource& place : renaming.places) {
    const Outline& outline = place.source->outline;
    const uint32_t scope = outline.scope_at(place.span.begin);
    for (const NameSpace space :
         {NameSpace::kVariables, NameSpace::kFunctions, NameSpace::kModules}) {
      const uint32_t own = outline.find(space, name, scope, nullptr);
      if (own != kNone || query.sources.find(place.source, space, name))
        return quoted + " has a meaning in " + place.source->path + " already";
    }
  }
  return {};
}

}  // namespace serve
