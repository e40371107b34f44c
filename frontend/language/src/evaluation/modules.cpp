#include "evaluation/modules.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "language/make.hpp"
#include "values/range.hpp"
#include "values/value_text.hpp"

namespace language {

namespace {

constexpr uint32_t kRangeLimit = 10000;  // of a range of this count and more nothing is selected

constexpr size_t kWorkOfMessage = 128;  // about a child that is not there, which takes some 500 ns

}  // namespace

ModuleCalls::ModuleCalls(Compiler& compiler, ModuleEnvironment& environment,
                         std::vector<std::string_view>& names, NodeTree& tree, CallStack& stack)
    : compiler_(compiler),
      environment_(environment),
      names_(names),
      tree_(tree),
      stack_(stack),
      builtins_(builtin_modules(compiler.dialect().version)),
      fragments_number_(compiler.names().find("$fn")),
      fragments_angle_(compiler.names().find("$fa")),
      fragments_size_(compiler.names().find("$fs")),
      fragments_error_(compiler.dialect().has_chord_error ? compiler.names().find("$fe") : kNoName),
      parent_modules_(compiler.names().find("$parent_modules")) {}

void ModuleCalls::begin_node(NodeKind kind, uint8_t modifiers, bool is_list) {
  const uint32_t first = is_list ? tree_.size() : tree_.open(kind, modifiers, stack_.place());
  open_nodes_.push_back({first, modifiers, is_list});
}

void ModuleCalls::end_node(bool drop_if_empty) {
  const OpenNode open = open_nodes_.back();
  open_nodes_.pop_back();
  if (open.is_list) {
    if (!drop_if_empty || open.first < tree_.size()) note_list();
    if (open.modifiers == 0) return;
    for (uint32_t node = open.first; node < tree_.size(); ++node)
      tree_.nodes[node].modifiers |= open.modifiers;
    return;
  }
  tree_.close(open.first);
  if (drop_if_empty && tree_.nodes[open.first].end == open.first + 1) tree_.remove(open.first);
}

/// Lets the innermost node know that a list belongs to it.
void ModuleCalls::note_list() {
  for (auto open = open_nodes_.rbegin(); open != open_nodes_.rend(); ++open) {
    if (open->is_list) continue;
    tree_.nodes[open->first].has_lists = true;
    return;
  }
}

void ModuleCalls::remove_open_nodes() {
  if (!open_nodes_.empty() && open_nodes_.front().first < tree_.size())
    tree_.remove(open_nodes_.front().first);
}

BuiltinCall ModuleCalls::builtin_call(const NodeSite& site, bool has_first) {
  ValueStack& values = stack_.values;
  const uint32_t above = has_first ? 1 : 0;
  return {{values.end() - above - site.parameters, site.parameters},
          has_first ? values.top() : Value::unset(),
          dynamic_value(fragments_number_),
          dynamic_value(fragments_angle_),
          dynamic_value(fragments_size_),
          fragments_error_ == kNoName ? Value::undef() : dynamic_value(fragments_error_),
          stack_.place(),
          environment_};
}

bool ModuleCalls::wants_first(const NodeSite& site) {
  return builtins_[site.module].wants_first(builtin_call(site, false));
}

Value ModuleCalls::dynamic_value(Name name) {
  stack_.recorder.note_read(name);
  const Value& value = stack_.dynamic[name];
  return value.is_set() ? value : Value::undef();
}

void ModuleCalls::make_node(const NodeSite& site, uint32_t no_children, bool takes_children) {
  stack_.steps.count();
  begin_node(NodeKind::kGroup, site.modifiers);
  const Made made = builtins_[site.module].make(builtin_call(site, true), tree_);
  stack_.values.drop_to(stack_.values.size() - site.parameters - 1);
  if (made == Made::kNode && takes_children) return;
  stack_.jump(no_children);
  end_node(false);
  if (made == Made::kNothing) tree_.remove(tree_.size() - 1);
}

void ModuleCalls::add_name(Name name) { names_.push_back(compiler_.names().text(name)); }

void ModuleCalls::bind_count() {
  stack_.dynamic.bind(parent_modules_, static_cast<double>(names_.size()));
}

void ModuleCalls::call(const CallSite& site) {
  ModuleEntry& module = *site.module;
  if (stack_.nests_too_deeply())
    stack_.fail_recursion("module", stack_.text_of(module.name), module.place);
  HeapScope* block_scope = nullptr;
  if (site.block) {
    block_scope = block_scopes_.back();
    block_scopes_.pop_back();
  }
  HeapScope* const scope = stack_.take_scope_around(site.is_in_unit, site.scope);
  begin_node(NodeKind::kGroup, site.modifiers);
  tree_.nodes[open_nodes_.back().first].is_module_call = true;
  activations_.push_back({&module, site.block, block_scope, stack_.frame().activation});
  const Code& code = compiler_.code_of(module);
  stack_.push(code, stack_.values.size() - site.slots, scope, FrameKind::kModule,
              static_cast<uint32_t>(activations_.size() - 1));
  stack_.frame().callee = &module;
  stack_.frame().call = module.place;
  for (uint32_t slot = site.slots; slot < code.slots; ++slot) stack_.values.push(Value::unset());
}

void ModuleCalls::return_from_call() {
  stack_.dynamic.undo(stack_.frame().trail);
  HeapScopes::release(activations_.back().block_scope);
  activations_.pop_back();
  names_.pop_back();
  stack_.leave();
  end_node(false);
}

const Activation* ModuleCalls::activation() const {
  const uint32_t number = stack_.frame().activation;
  return number == kNoActivation ? nullptr : &activations_[number];
}

void ModuleCalls::refuse_children(const NodeSite& site) {
  stack_.warn("module " + std::string(site.call_name) + "() does not support child modules",
              PathBase::kMainFile);
}

void ModuleCalls::say_successor(const NodeSite& site) {
  environment_.messages.say(MessageGroup::kDeprecated,
                            "The " + std::string(site.call_name) +
                                "() module will be removed in future releases. Use " +
                                std::string(site.successor) + " instead.",
                            stack_.place(), PathBase::kMainFile);
}

void ModuleCalls::unknown_module(Name name) {
  stack_.warn("Ignoring unknown module '" + stack_.text_of(name) + "'", PathBase::kMainFile);
}

void ModuleCalls::pop_overwritten(Name parameter, Name module) {
  if (!stack_.values.pop().is_set()) return;
  const std::string module_name = stack_.text_of(module), name = stack_.text_of(parameter);
  const Dialect& dialect = compiler_.dialect();
  stack_.warn(dialect.names_module_of_parameter
                  ? filled(dialect.overwritten_parameter, {module_name, name})
                  : filled(dialect.overwritten_parameter, {name}),
              PathBase::kUnit);
}

uint32_t Children::count() const {
  const Activation* const module = modules_.activation();
  return module && module->block ? static_cast<uint32_t>(module->block->calls.size()) : 0;
}

void Children::say_child_is_deprecated() {
  stack_.messages().say_without_place(
      MessageGroup::kDeprecated,
      "child() will be removed in future releases. Use children() instead.", stack_.place());
}

// Children run where they are written: in the scope and among the children of their call.
void Children::run(FrameKind kind, uint32_t child) {
  const Activation& module = *modules_.activation();
  if (stack_.nests_too_deeply()) stack_.fail_recursion("module", "children", stack_.place());
  const Code& code = compiler_.code_of(*module.block);
  stack_.push(code, stack_.values.size(), HeapScopes::acquire(module.block_scope), kind,
              module.block_activation);
  stack_.jump(code.entries[child]);
}

void Children::run_all(const NodeSite& site) {
  modules_.begin_node(site);
  if (count()) run(FrameKind::kBlock, 0);
}

bool Children::end_child(bool is_last) {
  if (stack_.frame().kind == FrameKind::kSelection) return !goes_to_next();
  if (stack_.frame().kind == FrameKind::kBlock && !is_last) return false;
  stack_.leave();
  return true;
}

// Returns whether there is a child of that number, and says if not.
bool Children::is_child_number(int number, bool is_child) {
  if (number >= 0 && static_cast<uint32_t>(number) < count()) return true;
  if (number >= 0 && !modules_.activation()) return false;
  const std::string text = std::to_string(number);
  const std::string what = is_child ? "hild index (" : "hildren index (";
  const std::string problem =
      number < 0 ? "Negative c" + what + text + ") not allowed"
                 : "C" + what + text + ") out of bounds (" + std::to_string(count()) + " children)";
  if (is_child) {
    stack_.warn(problem, PathBase::kMainFile);
  } else {
    stack_.messages().say(MessageGroup::kWarning, problem);
  }
  return false;
}

bool Children::select(const NodeSite& site, bool is_child) {
  Value selection = stack_.values.pop();
  const bool is_number = selection.is_number() || is_child;
  if (is_number) {
    const int number = compiler_.dialect().integer(selection.is_number() ? selection.number() : 0);
    if (!is_child_number(number, is_child)) return false;
    selection = make_vector(1);
    append_element(selection, static_cast<double>(number));
  } else if (!selection.is_vector() && !selection.is_range()) {
    stack_.warn("Bad parameter type (" + echo_text(selection) +
                    ") for children, only accept: empty, number, vector, range",
                PathBase::kMainFile);
    return false;
  } else if (selection.is_range() && selection.range().count() >= kRangeLimit) {
    stack_.warn("Bad range parameter for children: too many elements (" +
                    std::to_string(selection.range().count()) + ")",
                PathBase::kMainFile);
    return false;
  }
  if (!is_number) modules_.begin_node(site);
  stack_.values.push(std::move(selection));
  stack_.values.push(0.0);
  stack_.values.push(Value::boolean(!is_number));
  return true;
}

// The number of a child in a selection; unset behind the last.
Value Children::selected(const Value& selection, uint32_t done) {
  if (selection.is_range()) {
    if (done >= selection.range().steps()) return Value::unset();
    return selection.range().value(done);
  }
  return done < selection.elements().size() ? selection.elements()[done] : Value::unset();
}

void Children::run_next(uint32_t slot, uint32_t after) {
  for (;;) {
    count_work(kWorkOfMessage);
    const auto done = static_cast<uint32_t>(stack_.slot(slot + 1).number());
    stack_.slot(slot + 1) = done + 1.0;
    const Value index = selected(stack_.slot(slot), done);
    if (!index.is_set()) return stack_.jump(after);
    if (!index.is_number()) {
      std::string text;
      append_str_text(text, index);
      stack_.messages().say(MessageGroup::kWarning,
                            "Bad parameter type (" + text +
                                ") for children, only accept: empty, number, vector, range.");
    } else if (is_child_number(compiler_.dialect().integer(index.number()), false)) {
      return run(FrameKind::kChild, static_cast<uint32_t>(index.number()));
    }
  }
}

// Returns whether there is a child of that number, and says if not.
bool Children::is_inside(int number) {
  if (number >= 0 && static_cast<uint32_t>(number) < count()) return true;
  stack_.warn("Children index (" + std::to_string(number) + ") out of bounds (" +
                  std::to_string(count()) + " children)",
              PathBase::kMainFile);
  return false;
}

void Children::refuse_type(const std::string& text, std::string_view end) {
  stack_.warn("Bad parameter type (" + text +
                  ") for children, only accept: empty, number, vector, range" + std::string(end),
              PathBase::kMainFile);
}

// Returns the numbers of the children that a selection means; nothing if there is to be no node.
std::optional<Value> Children::numbers_of(const Value& selection) {
  Value numbers = make_vector();
  if (!selection.is_set()) {
    for (uint32_t number = 0; number < count(); ++number)
      append_element(numbers, static_cast<double>(number));
  } else if (selection.is_number()) {
    if (!is_inside(compiler_.dialect().integer(selection.number()))) return std::nullopt;
    append_element(numbers, std::trunc(selection.number()));
  } else if (selection.is_range() && selection.range().count() >= kRangeLimit) {
    stack_.warn("Bad range parameter for children: too many elements (" +
                    std::to_string(selection.range().count()) + ")",
                PathBase::kMainFile);
    return std::nullopt;
  } else if (selection.is_vector() || selection.is_range()) {
    append_existing(numbers, selection);
  } else {
    refuse_type(echo_text(selection), "");
    return std::nullopt;
  }
  return numbers;
}

void Children::append_existing(Value& numbers, const Value& selection) {
  for (uint32_t done = 0;; ++done) {
    count_work(kWorkOfMessage);
    const Value index = selected(selection, done);
    if (!index.is_set()) return;
    if (!index.is_number()) {
      std::string text;
      append_str_text(text, index);
      refuse_type(text, ".");
    } else if (is_inside(compiler_.dialect().integer(index.number()))) {
      append_element(numbers, std::trunc(index.number()));
    }
  }
}

void Children::run_selection(const NodeSite& site, uint32_t none, bool is_child) {
  Value selection = stack_.values.pop();
  if (!modules_.activation()) return stack_.jump(none);
  if (is_child && !selection.is_set()) selection = 0.0;
  std::optional<Value> numbers = numbers_of(selection);
  if (!numbers) return stack_.jump(none);
  modules_.begin_node(site);
  const Activation& module = *modules_.activation();
  if (!module.block) return;
  if (stack_.nests_too_deeply()) stack_.fail_recursion("module", "children", stack_.place());
  const Code& code = compiler_.code_of(*module.block);
  ValueStack& values = stack_.values;
  const uint32_t base = values.size();
  values.reserve(base + kSelectionSlots);
  values.push(std::move(*numbers));
  values.push(0.0);
  stack_.push(code, base, HeapScopes::acquire(module.block_scope), FrameKind::kSelection,
              module.block_activation);
}

// Goes to the next child that the frame runs, or ends it and returns false.
bool Children::goes_to_next() {
  const auto done = static_cast<uint32_t>(stack_.slot(1).number());
  const Value next = selected(stack_.slot(0), done);
  stack_.slot(1) = done + 1.0;
  if (next.is_set()) {
    stack_.jump(stack_.code().entries[static_cast<uint32_t>(next.number())]);
  } else {
    stack_.leave();
  }
  return next.is_set();
}

void Children::end_selection() {
  const bool is_group = stack_.values.pop().boolean();
  stack_.values.drop();
  stack_.values.drop();
  if (is_group) modules_.end_node(false);
}

}  // namespace language
