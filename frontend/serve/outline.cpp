#include "outline.hpp"

#include <algorithm>
#include <utility>

namespace serve {
namespace {

enum class FrameKind : uint8_t {
  // Within these, a statement comes next:
  kFile,
  kBlock,   // { … }
  kHead,    // a module's call or an `if`, whose children come next
  kModule,  // a definition whose body comes next
  // Within these, an expression:
  kFunction,    // function f(…) = …
  kAssignment,  // a = …
  kExpression,  // what reaches as far right as possible: let, for, function literals
  kParenthesis,
  kBracket,
};

enum class Role : uint8_t { kGroup, kArguments, kDefinitions, kParameters };

/// Something that has begun and not ended.
struct Frame {
  FrameKind kind;
  uint32_t scope;               // of what stands in it
  uint32_t own_scope = kNone;   // which ends with it
  uint32_t target = kNone;      // the scope that its items define names in
  uint32_t value_of = kNone;    // Reference::value_of of what stands in it
  uint32_t definition = kNone;  // that it is; of a parenthesis, the one of its current item
  uint32_t owner = kNone;       // whose parameters stand in it
  uint32_t reference = kNone;   // that it calls
  Role role = Role::kGroup;
  bool is_item_start = true;
  uint32_t item = 0;
  std::string_view item_name{};
  uint32_t questions = 0;  // ? that lack their colon
  uint32_t ifs = 0;        // ifs that may have an else
  bool is_if = false;      // of a head, before its else
};

bool is_statement_frame(const Frame& frame) { return frame.kind <= FrameKind::kModule; }
bool is_head(const Frame& frame) {
  return frame.kind == FrameKind::kHead || frame.kind == FrameKind::kModule;
}
bool encloses_items(const Frame& frame) {
  return frame.kind == FrameKind::kParenthesis || frame.kind == FrameKind::kBracket;
}

bool defines_in_arguments(std::string_view module) {
  return module == "for" || module == "let" || module == "assign" || module == "intersection_for";
}

class Reader {
 public:
  /// Reads the tokens up to `end`.
  Reader(Outline& out, std::size_t end) : out_(out), text_(out.text->bytes()) {
    for (std::size_t i = 0; i < end; ++i)
      if (out.tokens[i].kind != TokenKind::kComment) code_.push_back(static_cast<uint32_t>(i));
    out_.scopes.push_back({{0, out.text->size()}, kNone});
    frames_.push_back({FrameKind::kFile, 0});
    for (at_ = 0; at_ < code_.size(); ++at_) read(token(at_));
  }

  void finish() {
    while (frames_.size() > 1) pop(out_.text->size());
  }
  const std::vector<Frame>& frames() const { return frames_; }
  /// Returns the last token that was read; "" if there is none.
  std::string_view last() const { return code_.empty() ? "" : word(token(code_.size() - 1)); }

 private:
  const Token& token(std::size_t at) const { return out_.tokens[code_[at]]; }
  std::string_view word(const Token& token) const { return out_.text->at(token.span); }
  std::string_view next() const { return at_ + 1 < code_.size() ? word(token(at_ + 1)) : ""; }
  bool is_next_name() const {
    return at_ + 1 < code_.size() && token(at_ + 1).kind == TokenKind::kWord &&
           !is_reserved(next());
  }
  std::string_view previous() const { return at_ > 0 ? word(token(at_ - 1)) : ""; }
  uint32_t previous_end() const { return at_ > 0 ? token(at_ - 1).span.end : 0; }
  Frame& top() { return frames_.back(); }
  bool is_first_in_line() const {
    const std::string_view gap =
        text_.substr(previous_end(), token(at_).span.begin - previous_end());
    return gap.find('\n') != gap.npos;
  }

  uint32_t open_scope() {
    out_.scopes.push_back({{token(at_).span.begin, out_.text->size()}, top().scope});
    return static_cast<uint32_t>(out_.scopes.size() - 1);
  }
  Frame& push(FrameKind kind, uint32_t scope, uint32_t own_scope = kNone) {
    Frame frame{kind, scope, own_scope};
    if (!is_statement_frame(top())) frame.value_of = top().value_of;
    frames_.push_back(frame);
    return top();
  }
  Frame& push_parenthesis(Role role, uint32_t scope) {
    ++at_;
    Frame& frame = push(FrameKind::kParenthesis, scope);
    frame.role = role;
    frame.target = scope;
    return frame;
  }
  /// Ends the innermost frame, at an offset.
  void pop(uint32_t end) {
    const Frame frame = top();
    frames_.pop_back();
    if (frame.own_scope != kNone) out_.scopes[frame.own_scope].span.end = end;
    if (frame.definition != kNone) end_definition(frame.definition, end);
  }
  void end_definition(uint32_t definition, uint32_t end) {
    Definition& ended = out_.definitions[definition];
    ended.span.end = std::max(ended.span.end, end);
    if (ended.has_value) ended.value.end = std::max(ended.value.begin, previous_end());
  }
  /// Adds a definition, whose name is the current token.
  uint32_t define(SymbolKind kind, uint32_t scope, std::size_t first) {
    const Span name = token(at_).span;
    Definition made{kind, word(token(at_)), name, {token(first).span.begin, name.end}, {}, scope};
    made.token = code_[first];
    out_.definitions.push_back(std::move(made));
    return static_cast<uint32_t>(out_.definitions.size() - 1);
  }
  /// Notes that the value of a definition begins behind the next token, a `=`, which is consumed.
  void begin_value(uint32_t definition) {
    ++at_;
    const uint32_t end = token(at_).span.end;
    const uint32_t begin = at_ + 1 < code_.size() ? token(at_ + 1).span.begin : end;
    out_.definitions[definition].value = {begin, begin};
    out_.definitions[definition].has_value = true;
  }
  uint32_t refer(ReferenceKind kind, uint32_t callee = kNone) {
    const Token& name = token(at_);
    out_.references.push_back({kind, word(name), name.span, top().scope, top().value_of, callee});
    return static_cast<uint32_t>(out_.references.size() - 1);
  }

  void read(const Token& read) {
    const bool is_broken =
        read.kind == TokenKind::kString && (!word(read).ends_with('"') || word(read).size() == 1);
    if (is_broken) {  // the rest of its line is in it, perhaps with what would have ended things
      unwind_to_statement(read.span.end);
      end_unfinished_heads();
    } else if (read.kind == TokenKind::kInclude || read.kind == TokenKind::kUse) {
      out_.files.push_back({read.kind == TokenKind::kUse, path_of(text_, read)});
    } else if (is_statement_frame(top())) {
      read_in_statement(read);
    } else {
      read_in_expression(read);
    }
  }

  // Statements.

  void read_in_statement(const Token& read) {
    const std::string_view said = word(read);
    if (read.kind == TokenKind::kWord) return read_statement(said);
    if (said == "{") {
      push(FrameKind::kBlock, top().scope);
    } else if (said == "}") {
      close_block();
    } else if (said == ";") {
      end_statement();
    } else if (said == "(" || said == "[") {
      push(said == "(" ? FrameKind::kParenthesis : FrameKind::kBracket, top().scope);
    }
  }

  void read_statement(std::string_view said) {
    const bool is_definition = said == "module" || said == "function";
    if (is_definition && is_next_name()) return read_definition(said == "module");
    if (said == "if") {
      const uint32_t outer = top().scope, scope = open_scope();
      push(FrameKind::kHead, scope, scope).is_if = true;
      if (next() == "(") push_parenthesis(Role::kGroup, outer);
    } else if (next() == "=" && !is_reserved(said)) {
      const uint32_t definition = define(SymbolKind::kVariable, top().scope, at_);
      Frame& frame = push(FrameKind::kAssignment, top().scope);
      frame.definition = frame.value_of = definition;
      begin_value(definition);
    } else if (next() == "(" && !is_definition) {
      const bool defines = defines_in_arguments(said);
      const uint32_t outer = top().scope, called = refer(ReferenceKind::kModule);
      const uint32_t scope = open_scope();
      push(FrameKind::kHead, scope, scope);
      Frame& frame = push_parenthesis(defines ? Role::kDefinitions : Role::kArguments,
                                      defines ? scope : outer);
      frame.reference = called;
    }
  }

  void read_definition(bool is_module) {
    const std::size_t first = at_;
    const uint32_t outer = top().scope, scope = open_scope();
    ++at_;
    const uint32_t definition =
        define(is_module ? SymbolKind::kModule : SymbolKind::kFunction, outer, first);
    out_.definitions[definition].inner = scope;
    push(is_module ? FrameKind::kModule : FrameKind::kFunction, scope, scope).definition =
        definition;
    if (next() == "(") push_parameters(scope, definition, outer);
  }

  /// Defaults are evaluated outside of the scope of the parameters.
  void push_parameters(uint32_t scope, uint32_t owner, uint32_t outer) {
    Frame& frame = push_parenthesis(Role::kParameters, outer);
    frame.target = scope;
    frame.owner = owner;
  }

  void end_statement() {
    const uint32_t end = token(at_).span.end;
    while (is_head(top())) {
      if (top().is_if && next() == "else") {
        ++at_;
        out_.scopes[top().own_scope].span.end = end;
        top().is_if = false;
        const uint32_t outer = out_.scopes[top().own_scope].parent;
        out_.scopes.push_back({{token(at_).span.begin, out_.text->size()}, outer});
        top().scope = top().own_scope = static_cast<uint32_t>(out_.scopes.size() - 1);
        return;
      }
      pop(end);
    }
  }

  void close_block() {
    const auto is_block = [](const Frame& frame) { return frame.kind == FrameKind::kBlock; };
    if (std::ranges::none_of(frames_, is_block)) return;
    while (!is_block(top())) pop(token(at_).span.begin);
    pop(token(at_).span.end);
    end_statement();
  }

  /// Ends the expressions that are open, which may lack their ends.
  void unwind_to_statement(uint32_t end) {
    while (!is_statement_frame(top())) pop(end);
  }

  // Expressions.

  /// Returns whether a word begins a statement, because the one before lacks its end.
  bool begins_statement(std::string_view said) {
    if (said == "module") return is_next_name();
    if (said == "function" && is_next_name()) return true;
    const bool may_be_item =
        top().kind == FrameKind::kParenthesis && top().is_item_start && top().role != Role::kGroup;
    return next() == "=" && !may_be_item && is_first_in_line() && !is_reserved(said);
  }

  void read_in_expression(const Token& read) {
    const std::string_view said = word(read);
    if (read.kind == TokenKind::kWord) {
      if (begins_statement(said)) {
        unwind_to_statement(previous_end());
        end_unfinished_heads();
        return read_statement(said);
      }
      read_word(said);
    } else if (read.kind == TokenKind::kSign) {
      read_sign(said, read.span);
    } else {
      top().is_item_start = false;
    }
  }

  void end_unfinished_heads() {
    while (top().kind == FrameKind::kHead) pop(previous_end());
  }

  void read_word(std::string_view said) {
    const bool is_item_start = std::exchange(top().is_item_start, false);
    if (previous() == ".") return;  // a member
    const bool is_called = next() == "(";
    if (said == "let" || said == "for") {
      push_scope(top().value_of);
      if (is_called) push_parenthesis(Role::kDefinitions, top().scope);
    } else if (said == "function") {
      read_literal();
    } else if (said == "if") {
      ++top().ifs;
    } else if (said == "else") {
      while (top().kind == FrameKind::kExpression && top().ifs == 0) pop(previous_end());
      if (top().ifs > 0) --top().ifs;
    } else if (is_reserved(said) && !is_called) {
      return;  // true, undef, each …
    } else if (is_item_start && top().kind == FrameKind::kParenthesis &&
               top().role == Role::kParameters) {
      add_item(SymbolKind::kParameter);
    } else if (is_item_start && next() == "=" && top().kind == FrameKind::kParenthesis &&
               top().role != Role::kGroup) {
      if (top().role == Role::kDefinitions) return add_item(SymbolKind::kVariable);
      top().item_name = said;
      refer(ReferenceKind::kArgument, top().reference);
      ++at_;
    } else if (is_called) {
      const uint32_t called = refer(ReferenceKind::kCall);
      push_parenthesis(Role::kArguments, top().scope).reference = called;
    } else {
      refer(ReferenceKind::kVariable);
    }
  }

  void push_scope(uint32_t value_of) {
    const uint32_t scope = open_scope();
    push(FrameKind::kExpression, scope, scope).value_of = value_of;
  }

  void read_literal() {
    const bool is_value = previous() == "=";
    const uint32_t owner = is_value ? top().definition : kNone, outer = top().scope;
    push_scope(kNone);  // its body runs later
    if (owner != kNone) out_.definitions[owner].inner = top().scope;
    if (next() == "(") push_parameters(top().scope, owner, outer);
  }

  /// Adds what an item of `let (…)` or of parameters defines.
  void add_item(SymbolKind kind) {
    const uint32_t definition = define(kind, top().target, at_);
    top().definition = definition;
    if (kind == SymbolKind::kVariable) top().value_of = definition;
    if (kind == SymbolKind::kParameter && top().owner != kNone)
      out_.definitions[top().owner].parameters.push_back(definition);
    if (next() == "=") begin_value(definition);
  }

  void read_sign(std::string_view said, Span span) {
    if (said == "(") {
      const bool is_call = previous() == ")" || previous() == "]";
      top().is_item_start = false;
      push(FrameKind::kParenthesis, top().scope).role = is_call ? Role::kArguments : Role::kGroup;
    } else if (said == "[") {
      top().is_item_start = false;
      push(FrameKind::kBracket, top().scope);
    } else if (said == ")") {
      close(FrameKind::kParenthesis, span.end);
    } else if (said == "]") {
      close(FrameKind::kBracket, span.end);
    } else if (said == "{" || said == "}") {
      unwind_to_statement(span.begin);
      read_in_statement(token(at_));
    } else if (said == ",") {
      next_item(span.begin);
    } else if (said == ";") {
      pop_expressions(span.begin);
      const bool is_c_style = top().kind == FrameKind::kParenthesis &&
                              top().role == Role::kDefinitions && top().reference == kNone;
      if (is_c_style) return next_item(span.begin);
      unwind_to_statement(span.end);
      end_statement();
    } else if (said == "?") {
      ++top().questions;
    } else if (said == ":") {
      while (top().kind == FrameKind::kExpression && top().questions == 0) pop(span.begin);
      if (top().questions > 0) --top().questions;
    } else if (said == "=" && top().kind == FrameKind::kFunction) {
      Definition& function = out_.definitions[top().definition];
      const uint32_t begin = at_ + 1 < code_.size() ? token(at_ + 1).span.begin : span.end;
      if (!function.has_value) function.value = {begin, begin};
      function.has_value = true;
    } else {
      top().is_item_start = false;
    }
  }

  void pop_expressions(uint32_t end) {
    while (top().kind == FrameKind::kExpression) pop(end);
  }

  void next_item(uint32_t end) {
    pop_expressions(end);
    if (!encloses_items(top())) return;
    end_item(end);
    ++top().item;
    top().is_item_start = true;
    top().item_name = {};
    top().questions = 0;
  }
  void end_item(uint32_t end) {
    if (top().definition != kNone) end_definition(top().definition, end);
    top().definition = kNone;
  }

  void close(FrameKind kind, uint32_t end) {
    pop_expressions(previous_end());
    const auto first = std::find_if(frames_.rbegin(), frames_.rend(), [&](const Frame& frame) {
      return frame.kind == kind || is_statement_frame(frame);
    });
    if (first == frames_.rend() || first->kind != kind) return;
    while (top().kind != kind) pop(previous_end());
    end_item(previous_end());
    pop(end);
    // The brackets of a condition without children, `if (a)`, are followed by a statement.
  }

  Outline& out_;
  std::string_view text_;
  std::vector<uint32_t> code_;  // the tokens that are no comments
  std::size_t at_ = 0;          // the current one of them
  std::vector<Frame> frames_;
};

bool is_blank_line(std::string_view text) { return std::ranges::count(text, '\n') > 1; }

/// Appends a comment without its marks.
void append_comment(std::string& out, std::string_view comment) {
  const bool is_block = comment.starts_with("/*");
  comment.remove_prefix(2);
  if (is_block && comment.ends_with("*/")) comment.remove_suffix(2);
  while (!comment.empty()) {
    std::string_view line = comment.substr(0, comment.find('\n'));
    comment.remove_prefix(std::min(line.size() + 1, comment.size()));
    const std::size_t text = line.find_first_not_of(is_block ? " \t*" : "/ \t");
    line.remove_prefix(std::min(text, line.size()));
    while (line.ends_with(' ') || line.ends_with('\r') || line.ends_with('\t'))
      line.remove_suffix(1);
    out.append(line) += '\n';
  }
}

}  // namespace

Outline outline_of(TextPointer text) {
  Outline outline;
  outline.tokens = tokens_of(text->bytes());
  outline.text = std::move(text);
  Reader(outline, outline.tokens.size()).finish();
  for (uint32_t i = 0; i < outline.definitions.size(); ++i)
    outline.by_name[outline.definitions[i].name].push_back(i);
  return outline;
}

uint32_t Outline::scope_at(std::size_t offset) const {
  for (std::size_t i = scopes.size(); i-- > 1;)
    if (scopes[i].span.begin <= offset && offset <= scopes[i].span.end)
      return static_cast<uint32_t>(i);
  return 0;
}

uint32_t Outline::find(NameSpace space, std::string_view name, uint32_t scope,
                       const Reference* reference) const {
  const bool is_dynamic = name.starts_with('$');
  const auto named = by_name.find(name);
  if (named == by_name.end()) return kNone;
  for (; scope != kNone; scope = scopes[scope].parent) {
    for (auto i = named->second.rbegin(); i != named->second.rend(); ++i) {
      const Definition& found = definitions[*i];
      if (found.scope != scope || found.name_space() != space) continue;
      if (reference && !is_dynamic && reference->value_of != kNone) {
        const Definition& around = definitions[reference->value_of];
        const bool is_later = found.name_span.begin >= around.name_span.begin;
        if (around.scope == scope && is_later) continue;
      }
      return *i;
    }
  }
  return kNone;
}

uint32_t Outline::resolve(const Reference& reference) const {
  const auto find_in = [&](NameSpace space) {
    return find(space, reference.name, reference.scope, &reference);
  };
  switch (reference.kind) {
    case ReferenceKind::kVariable:
      return find_in(NameSpace::kVariables);
    case ReferenceKind::kModule:
      return find_in(NameSpace::kModules);
    case ReferenceKind::kCall: {
      const uint32_t variable = find_in(NameSpace::kVariables);
      return variable != kNone ? variable : find_in(NameSpace::kFunctions);
    }
    case ReferenceKind::kArgument: {
      if (reference.callee == kNone) return kNone;
      const uint32_t callee = resolve(references[reference.callee]);
      if (callee == kNone) return kNone;
      for (const uint32_t parameter : definitions[callee].parameters)
        if (definitions[parameter].name == reference.name) return parameter;
      return kNone;
    }
  }
  return kNone;
}

bool Outline::are_same(uint32_t a, uint32_t b) const {
  return definitions[a].scope == definitions[b].scope &&
         definitions[a].name_space() == definitions[b].name_space() &&
         definitions[a].name == definitions[b].name;
}

uint32_t Outline::reference_at(std::size_t offset) const {
  const auto found = std::ranges::find_if(
      references, [&](const Reference& reference) { return reference.span.touches(offset); });
  return found == references.end() ? kNone : static_cast<uint32_t>(found - references.begin());
}

uint32_t Outline::definition_at(std::size_t offset) const {
  const auto found = std::ranges::find_if(
      definitions, [&](const Definition& made) { return made.name_span.touches(offset); });
  return found == definitions.end() ? kNone : static_cast<uint32_t>(found - definitions.begin());
}

std::string Outline::comment_of(const Definition& definition) const {
  constexpr std::size_t kMostBytes = 4000;
  std::size_t first = definition.token;
  uint32_t begin = definition.span.begin;
  while (first > 0 && tokens[first - 1].kind == TokenKind::kComment) {
    const Span comment = tokens[first - 1].span;
    if (is_blank_line(text->at({comment.end, begin}))) break;
    // What stands behind a statement in its line is about that one.
    if (first > 1 && tokens[first - 2].kind != TokenKind::kComment &&
        text->line_of(tokens[first - 2].span.end) == text->line_of(comment.begin))
      break;
    begin = comment.begin;
    --first;
  }
  std::string result;
  for (; first < definition.token && result.size() < kMostBytes; ++first)
    append_comment(result, text->at(tokens[first].span));
  return result;
}

Context context_at(const Outline& outline, std::size_t offset) {
  Context context;
  std::size_t end = token_behind(outline.tokens, offset);
  if (end > 0 && outline.tokens[end - 1].span.end == offset) --end;  // what is being typed
  if (end < outline.tokens.size() && outline.tokens[end].span.begin < offset) {
    const Token& token = outline.tokens[end];
    switch (token.kind) {
      case TokenKind::kInclude:
      case TokenKind::kUse:
        for (const FileName& file : outline.files)
          if (file.path.touches(offset)) context.file = &file;
        if (context.file) return context;
        ++end;
        break;
      case TokenKind::kComment: {
        const bool is_line = outline.text->at(token.span).starts_with("//");
        context.is_text = is_line || offset < token.span.end;
        break;
      }
      case TokenKind::kString:
        context.is_text = offset < token.span.end || outline.text->bytes()[offset - 1] != '"' ||
                          token.span.end == token.span.begin + 1;
        break;
      case TokenKind::kNumber:
        context.is_text = true;
        break;
      case TokenKind::kWord:
        break;
      case TokenKind::kSign:
        if (token.span.end <= offset) ++end;
        break;
    }
    if (context.is_text) return context;
    if (token.kind == TokenKind::kString || token.kind == TokenKind::kComment) ++end;
  }
  Outline scratch;
  scratch.text = outline.text;
  scratch.tokens = outline.tokens;
  const Reader reader(scratch, end);
  const Frame& top = reader.frames().back();
  context.is_statement = is_statement_frame(top);
  const bool is_item = top.kind == FrameKind::kParenthesis && top.is_item_start;
  context.begins_argument = is_item && top.role == Role::kArguments;
  const std::string_view last = reader.last();
  context.is_new_name = last == "module" || (last == "function" && context.is_statement) ||
                        (is_item && top.role == Role::kParameters);
  context.is_member = last == ".";
  for (const Frame& frame : reader.frames()) {
    if (frame.kind != FrameKind::kParenthesis || frame.role == Role::kGroup ||
        frame.role == Role::kParameters)
      continue;
    OpenCall call{};
    if (frame.reference != kNone) call.callee = scratch.references[frame.reference];
    call.argument = frame.item;
    call.argument_name = frame.item_name;
    if (frame.role == Role::kArguments || frame.reference != kNone) context.calls.push_back(call);
  }
  return context;
}

}  // namespace serve
