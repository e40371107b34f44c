// Completion and signature help.
#include <algorithm>
#include <filesystem>
#include <set>

#include "features.hpp"
#include "syntax/characters.hpp"

namespace serve {
namespace {

namespace fs = std::filesystem;

/// More would not be looked through.
constexpr std::size_t kMostCompletions = 2000;
constexpr std::size_t kMostAbout = 400;

char lower(char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c + 'a' - 'A') : c; }

/// Returns whether the letters of what is typed stand in a name in their order, in either case.
bool matches(std::string_view typed, std::string_view name) {
  for (const char c : name) {
    if (!typed.empty() && lower(typed.front()) == lower(c)) typed.remove_prefix(1);
  }
  return typed.empty();
}

/// Returns the first part of a documentation.
std::string shortened(std::string text) {
  if (text.size() <= kMostAbout) return text;
  std::size_t end = text.rfind('\n', kMostAbout);
  if (end == text.npos || end == 0) end = kMostAbout;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "…";
}

ItemKind kind_of(SymbolKind kind) {
  switch (kind) {
    case SymbolKind::kModule:
      return ItemKind::kModule;
    case SymbolKind::kFunction:
      return ItemKind::kFunction;
    case SymbolKind::kParameter:
      return ItemKind::kParameter;
    case SymbolKind::kVariable:
      break;
  }
  return ItemKind::kVariable;
}

class Completer {
 public:
  Completer(const Query& query, Completions& out)
      : query_(query), outline_(query.source->outline), out_(out) {
    const std::string& bytes = outline_.text->bytes();
    uint32_t begin = static_cast<uint32_t>(query.offset);
    while (begin > 0 && language::is_word(bytes[begin - 1])) --begin;
    if (begin > 0 && bytes[begin - 1] == '$') --begin;
    out.replaced = {begin, static_cast<uint32_t>(query.offset)};
    typed_ = outline_.text->at(out.replaced);
  }

  void complete(const Context& context) {
    if (context.is_member) {
      for (const char* name : {"x", "y", "z"}) add({name, ItemKind::kVariable, name, {}, {}});
      return;
    }
    if (context.begins_argument && !context.calls.empty()) add_parameters(context.calls.back());
    add_names(context.is_statement);
    add_builtins(context.is_statement);
  }

  void complete_file(const FileName& file) {
    const std::string typed(outline_.text->at({file.path.begin, out_.replaced.end}));
    const std::size_t slash = typed.rfind('/');
    const std::string folder = slash == typed.npos ? "" : typed.substr(0, slash + 1);
    typed_ = std::string_view(typed).substr(folder.size());
    out_.replaced.begin = out_.replaced.end - static_cast<uint32_t>(typed_.size());
    const bool is_absolute = folder.starts_with('/');
    for (const std::string& base : query_.sources.search_folders(*query_.source)) {
      if (!base.empty() || is_absolute) list(fs::path(base) / folder, file.is_use);
      if (is_absolute) break;
    }
  }

 private:
  void add(Completion completion) {
    if (out_.list.size() == kMostCompletions || !matches(typed_, completion.label)) return;
    const bool is_new = known_.insert({completion.kind, completion.label}).second;
    if (is_new) out_.list.push_back(std::move(completion));
  }

  void add(const Found& found, bool is_argument) {
    if (!matches(typed_, found->name)) return;
    const std::string name(found->name);
    add({name, kind_of(found->kind), is_argument ? name + " = " : name, signature_of(found),
         shortened(found.source->outline.comment_of(*found))});
  }

  void add_parameters(const OpenCall& call) {
    if (const auto found = query_.sources.resolve(query_.source, call.callee)) {
      for (const uint32_t parameter : (*found)->parameters) add({found->source, parameter}, true);
      return;
    }
    const BuiltinKind kind =
        call.callee.kind == ReferenceKind::kModule ? BuiltinKind::kModule : BuiltinKind::kFunction;
    const Builtin* const builtin = find_builtin(query_.version, kind, call.callee.name);
    if (!builtin) return;
    std::string_view rest = builtin->signatures;
    while (!rest.empty()) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(line.size() + 1, rest.size()));
      std::string_view list = line.substr(0, line.find(')'));
      list.remove_prefix(std::min(list.find('(') + 1, list.size()));
      add_words(list, builtin->signatures);
    }
  }

  /// Adds the names of a list of parameters; defaults in it may hold commas, but no names.
  void add_words(std::string_view list, std::string_view detail) {
    bool may_begin = true;
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (may_begin && language::is_word(list[i])) {
        std::size_t end = i;
        while (end < list.size() && language::is_word(list[end])) ++end;
        const std::string name(list.substr(i, end - i));
        if (!language::is_digit(name.front()))
          add({name, ItemKind::kParameter, name + " = ", std::string(detail), {}});
        i = end - 1;
      }
      may_begin = list[i] == ',' || (may_begin && list[i] == ' ');
    }
  }

  /// Adds what the design defines and is visible here. A statement begins with a module, or assigns
  /// a variable; an expression holds the rest.
  void add_names(bool is_statement) {
    std::set<uint32_t> scopes;
    for (uint32_t scope = outline_.scope_at(query_.offset); scope != kNone;
         scope = outline_.scopes[scope].parent)
      scopes.insert(scope);
    for (uint32_t i = 0; i < outline_.definitions.size(); ++i) {
      const Definition& found = outline_.definitions[i];
      const bool is_typed = found.name_span.touches(query_.offset);
      if (!is_typed && scopes.contains(found.scope)) add_if({query_.source, i}, is_statement);
    }
    add_top_levels(query_.sources.included(query_.source), is_statement, true);
    add_top_levels(query_.sources.used(query_.source), is_statement, false);
  }

  void add_top_levels(const std::vector<SourcePointer>& sources, bool is_statement,
                      bool has_variables) {
    for (const SourcePointer& source : sources) {
      if (source == query_.source) continue;
      for (uint32_t i = 0; i < source->outline.definitions.size(); ++i) {
        const Definition& found = source->outline.definitions[i];
        const bool is_visible = has_variables || found.name_space() != NameSpace::kVariables;
        if (found.scope == 0 && is_visible) add_if({source, i}, is_statement);
      }
    }
  }

  void add_if(const Found& found, bool is_statement) {
    const NameSpace space = found->name_space();
    if (is_statement ? space != NameSpace::kFunctions : space != NameSpace::kModules)
      add(found, false);
  }

  void add_builtins(bool is_statement) {
    for (const Builtin& builtin : builtins(query_.version)) {
      if (builtin.kind == (is_statement ? BuiltinKind::kFunction : BuiltinKind::kModule)) continue;
      if (builtin.kind == BuiltinKind::kVariable && is_statement && !builtin.name.starts_with('$'))
        continue;
      const ItemKind kind = builtin.kind == BuiltinKind::kModule     ? ItemKind::kModule
                            : builtin.kind == BuiltinKind::kFunction ? ItemKind::kFunction
                            : builtin.kind == BuiltinKind::kVariable ? ItemKind::kVariable
                                                                     : ItemKind::kWord;
      const std::string name(builtin.name);
      add({name, kind, name, std::string(builtin.signatures), std::string(builtin.about),
           builtin.is_deprecated});
    }
  }

  void list(const fs::path& folder, bool is_use) {
    std::error_code failed;
    for (fs::directory_iterator file(folder, failed), end; !failed && file != end;
         file.increment(failed)) {
      const std::string name = file->path().filename();
      if (name.starts_with('.')) continue;
      std::error_code unknown;
      if (file->is_directory(unknown)) {
        add({name + "/", ItemKind::kFolder, name + "/", {}, {}});
      } else if (name.ends_with(".scad") ||
                 (is_use && (name.ends_with(".ttf") || name.ends_with(".otf")))) {
        add({name, ItemKind::kFile, name, {}, {}});
      }
    }
  }

  const Query& query_;
  const Outline& outline_;
  Completions& out_;
  std::string_view typed_;
  std::set<std::pair<ItemKind, std::string>> known_;
};

/// Returns the parameters of a signature: what stands between the commas of its parentheses.
std::vector<Span> parameters_of(std::string_view label) {
  std::vector<Span> parameters;
  int depth = 0;
  uint32_t begin = 0;
  const auto add = [&](std::size_t end) {
    while (begin < end && label[begin] == ' ') ++begin;
    if (begin < end) parameters.push_back({begin, static_cast<uint32_t>(end)});
  };
  bool is_string = false;
  for (std::size_t i = 0; i < label.size(); ++i) {
    const char c = label[i];
    if (c == '"' && label[i - (i > 0 ? 1 : 0)] != '\\') is_string = !is_string;
    if (is_string) continue;
    if ((c == '(' || c == '[') && ++depth == 1) begin = static_cast<uint32_t>(i + 1);
    if (c == ',' && depth == 1) {
      add(i);
      begin = static_cast<uint32_t>(i + 1);
    }
    if ((c == ')' || c == ']') && --depth == 0) {
      add(i);
      break;
    }
  }
  return parameters;
}

/// Returns the parameter that an argument gives a value to.
std::optional<uint32_t> active_parameter(const Signature& signature, const OpenCall& call) {
  const auto name_of = [&](Span span) {
    std::size_t end = span.begin;
    while (end < span.end &&
           (language::is_word(signature.label[end]) || signature.label[end] == '$'))
      ++end;
    return std::string_view(signature.label).substr(span.begin, end - span.begin);
  };
  if (call.argument_name.empty())
    return call.argument < signature.parameters.size() ? std::optional(call.argument)
                                                       : std::nullopt;
  for (uint32_t i = 0; i < signature.parameters.size(); ++i)
    if (name_of(signature.parameters[i]) == call.argument_name) return i;
  return std::nullopt;
}

Signature make_signature(std::string label, std::string about) {
  std::vector<Span> parameters = parameters_of(label);
  return {std::move(label), std::move(parameters), std::move(about)};
}

std::vector<Signature> signatures_of(const Query& query, const Reference& callee) {
  std::vector<Signature> signatures;
  if (const auto found = query.sources.resolve(query.source, callee)) {
    signatures.push_back(
        make_signature(signature_of(*found), found->source->outline.comment_of(**found)));
    return signatures;
  }
  const bool is_module = callee.kind == ReferenceKind::kModule;
  const Builtin* builtin = find_builtin(
      query.version, is_module ? BuiltinKind::kModule : BuiltinKind::kFunction, callee.name);
  if (!builtin) builtin = find_builtin(query.version, BuiltinKind::kWord, callee.name);
  std::string_view rest = builtin ? builtin->signatures : "";
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    signatures.push_back(make_signature(std::string(line), std::string(builtin->about)));
  }
  return signatures;
}

/// Appends code in one line.
void append_code(std::string& out, std::string_view code) {
  constexpr std::size_t kMostBytes = 60;
  bool is_blank = false;
  std::string line;
  for (const char c : code) {
    if (language::is_blank(c)) {
      is_blank = !line.empty();
      continue;
    }
    if (std::exchange(is_blank, false)) line += ' ';
    line += c;
  }
  if (line.size() > kMostBytes) {
    std::size_t end = kMostBytes;
    while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0) == 0x80) --end;
    line.resize(end);
    line += "…";
  }
  out += line;
}

}  // namespace

Completions completions(const Query& query) {
  Completions result;
  Completer completer(query, result);
  const Context context = context_at(query.source->outline, query.offset);
  if (context.file)
    completer.complete_file(*context.file);
  else if (!context.is_text && !context.is_new_name)
    completer.complete(context);
  return result;
}

std::optional<SignatureHelp> signature_help(const Query& query) {
  const Context context = context_at(query.source->outline, query.offset);
  if (context.is_text && context.calls.empty()) return std::nullopt;
  for (auto call = context.calls.rbegin(); call != context.calls.rend(); ++call) {
    if (call->callee.name.empty()) continue;
    SignatureHelp help;
    help.signatures = signatures_of(query, call->callee);
    if (help.signatures.empty()) return std::nullopt;
    // The first that has the argument is shown.
    for (uint32_t i = 0; i < help.signatures.size() && !help.active_parameter; ++i) {
      help.active_parameter = active_parameter(help.signatures[i], *call);
      if (help.active_parameter) help.active = i;
    }
    return help;
  }
  return std::nullopt;
}

std::string signature_of(const Found& found) {
  const Definition& definition = *found;
  const Outline& outline = found.source->outline;
  std::string text(definition.name);
  if (definition.inner != kNone) {
    text += '(';
    for (const uint32_t parameter : definition.parameters) {
      if (text.back() != '(') text += ", ";
      text += signature_of({found.source, parameter});
    }
    text += ')';
  } else if (definition.has_value) {
    text += " = ";
    append_code(text, outline.text->at(definition.value));
  }
  return text;
}

}  // namespace serve
