// Compiles one Code: the body of a function or module, a block, a top level.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "code/code_builder.hpp"
#include "code/compiler.hpp"
#include "code/expression_facts.hpp"

namespace language {

/// Instructions of a Code, from one position to before another.
struct CodeRange {
  uint32_t begin, end;
};

/// The `$` names that hide those of a block, which are older although they are assigned later.
struct Hiding {
  std::span<const Argument> arguments{};  // of the call around the block
  const Scope* unit = nullptr;            // the file of the module that is called
  bool hides(Name name) const;
};

class CodeCompiler {
 public:
  /// `scope` is the one around the code.
  CodeCompiler(Compiler& compiler, Code& code, const ScopeLayout& scope)
      : compiler_(compiler), out_(code), scope_(const_cast<ScopeLayout*>(&scope)) {}

  /// Compiles the assignments of a file's top level. Returns whether they set `$` names.
  bool compile_unit(const Scope& scope);
  void compile_function(FunctionEntry& function);
  void compile_module(ModuleEntry& module);
  void compile_block(BlockEntry& block);
  /// Compiles the evaluation of the defaults that are no constants.
  void compile_defaults(Callable& callable, bool is_module);

 private:
  // expressions.cpp
  void expression(const Expression& expression);  // pushes its value
  void unary(const UnaryExpression& unary);
  void binary_chain(const BinaryExpression& binary);
  void logical(const BinaryExpression& binary);
  void ternary(const TernaryExpression& ternary);
  void index_chain(const Expression& expression);
  bool is_silent(const Expression& expression) const;
  void range(const RangeExpression& range);
  void vector(const VectorExpression& vector);
  void literal(const FunctionExpression& literal);
  uint32_t jump_if_false(const Expression& condition);

  // bodies.cpp: let, assert, echo
  void body_expression(const BodyExpression& expression);
  void bound_body(const BodyExpression& let);
  void let_arguments(std::span<const Argument> arguments, bool is_in_heap);
  void let_argument(const Argument& argument, ScopeLayout& scope);
  void assert_arguments(std::span<const Argument> arguments, Place place);
  void echo_arguments(std::span<const Argument> arguments, Place place);
  void body_or_undef(const Expression* body, Place place);

  // names.cpp
  void variable(Name name, Place place);
  /// Pushes a variable if one is set. Emits what comes where none is: `otherwise` is a kUndef or a
  /// kUnknownVariable.
  void variable_or(Name name, Place place, Op otherwise);
  void callee_variable(Name name, Place place);
  bool may_be_variable(Name name) const;
  bool is_known_variable(Name name) const;
  void store(Name name, Place place);  // pops into a variable of the innermost scope, or binds it
  uint32_t scope_number(const ScopeLayout& scope) const {
    return scope_->heap_depth - scope.heap_depth;
  }
  ScopeLayout& open_scope(bool is_in_heap, Place place);
  void set_scope_size(uint32_t position, const ScopeLayout& scope);
  void close_scope(Place place);

  // calls.cpp
  void call(const CallExpression& call);
  void named_call(const CallExpression& call, Name name);
  void builtin_call(const CallExpression& call, Name name);
  void assigned_call(const CallExpression& call, const FunctionShape& shape);
  void wrong_count(const CallExpression& call, uint32_t builtin);
  void lazy_call(const CallExpression& call, uint32_t builtin);
  void static_call(const CallExpression& call, Found<FunctionEntry> found, bool is_tail);
  void dynamic_call(const CallExpression& call, bool is_tail);
  void method(const Expression& callee);
  void is_undef_call(const CallExpression& call);
  void begin_call(const ParameterList& parameters, Place place, uint32_t number);
  void arguments(const ArgumentPlan& plan, std::span<const Argument> arguments, uint32_t base);
  void pass_arguments(const ArgumentPlan& plan, std::span<const Argument> arguments, uint32_t base,
                      Place place);
  void warn_of_arguments(const ArgumentPlan& plan, Place place, bool once);
  void defaults_of_callee(const Callable& callable);
  void bind_parameters(const Callable& callable);
  bool binds_dynamic(const Callable& callable, const ArgumentPlan& plan) const;
  uint32_t begin_region() const { return out_.here(); }
  void end_region(uint32_t begin, Name name, const Expression* callee, Place place,
                  bool is_tail = false);

  // tails.cpp
  void tail(const Expression& expression);  // returns its value from the function
  void tail_call(const CallExpression& call);
  void named_tail_call(const CallExpression& call);
  void any_tail_call(const CallExpression& call);
  void tail_jump(const CallExpression& call);
  void tail_defaults(const ArgumentPlan& plan, std::vector<uint32_t>& slots, Place place);
  /// Returns the variable that such a value reads first, if it is a call of a builtin function:
  /// after give_up(), a concat() finds that nothing else refers to its vector, and appends in
  /// place.
  std::optional<uint32_t> local_of_call(CodeRange value) const;
  bool is_read(uint32_t slot, CodeRange range) const;
  /// Lets the call that ends the code of a value give up a slot that is not read after it.
  void give_up(uint32_t slot, CodeRange value);

  // comprehensions.cpp
  void element(const Expression& element, uint32_t vector);  // appends to the vector in a slot
  void element_or_undef(const Expression* body, Place place, uint32_t vector);
  void if_element(const IfExpression& choice, uint32_t vector);
  void let_element(const BodyExpression& let, uint32_t vector);
  void for_elements(std::span<const Argument> sources, const BodyExpression& loop, bool is_in_heap,
                    uint32_t vector);
  void for_c_elements(const ForCExpression& loop, uint32_t vector);
  void declare_for_c(const ForCExpression& loop, ScopeLayout& scope);
  void for_c_assignments(std::span<const Argument> arguments, ScopeLayout& scope);
  void each_elements(const EachExpression& each, uint32_t vector);
  void drop_to(uint32_t depth, Place place);  // drops values until `depth` slots are in use

  // statements.cpp
  void assign(const Scope& scope, const ModuleEntry* module, const Hiding& hiding);
  void parameter_warning(const Assignment& assignment, const ModuleEntry& module);
  void statements(std::span<const ModuleCall> calls);
  void block(const Scope& scope);  // within the node that is begun
  void statement(const ModuleCall& call);
  bool special_statement(const ModuleCall& call);
  void if_statement(const ModuleCall& call);
  void plain_node(const ModuleCall& call, NodeKind kind);
  void group_or_list(const ModuleCall& call);
  void operation_node(const ModuleCall& call, NodeKind kind);
  void node_if_children(const ModuleCall& call);
  uint32_t add_node_site(const ModuleCall& call, NodeKind kind);
  uint32_t add_list_site(const ModuleCall& call);
  void begin_list(const ModuleCall& call);
  void begin_node(const ModuleCall& call, NodeKind kind);
  void end_node(const ModuleCall& call, bool drop_if_empty = false);
  bool assigns_dynamic(const Scope& scope) const;

  // module_calls.cpp
  void module_call(const ModuleCall& call, Found<ModuleEntry> found);
  void builtin_module(const ModuleCall& call, const ModuleShape& module);
  void builtin_arguments(const ModuleCall& call, const ModuleShape& module,
                         std::optional<uint32_t> refused = std::nullopt);
  void repeated_argument(const ModuleCall& call, const ModuleShape& module, uint32_t site);
  BlockEntry* save_block(const ModuleCall& call, const Hiding& hiding);
  void children_call(const ModuleCall& call, bool is_child);
  void plain_children_call(const ModuleCall& call, bool is_child);
  void selection_of_children(const ModuleCall& call, bool is_child);
  void unused_arguments(const ModuleCall& call);

  // loops.cpp
  void for_statement(const ModuleCall& call);
  void for_rounds(std::span<const Argument> sources, const ModuleCall& call);
  void let_statement(const ModuleCall& call);
  void assign_statement(const ModuleCall& call);

  bool contains_literal(const Expression& expression) {
    return literals_.contains_literal(expression);
  }
  bool contains_literal(std::span<const Argument> arguments);

  Compiler& compiler_;
  CodeBuilder out_;
  ScopeLayout* scope_;  // the innermost scope
  LiteralFinder literals_;
  FunctionEntry* function_ = nullptr;  // whose body is compiled
  ScopeLayout* parameter_scope_ = nullptr;
  uint32_t body_start_ = 0;     // where a tail call goes
  bool finds_all_set_ = false;  // statements run after the assignments around them
};

}  // namespace language
