// The calls of modules, the nodes that they make, and the children of these calls.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "code/compiler.hpp"
#include "evaluation/call_stack.hpp"
#include "language/node_tree.hpp"
#include "modules/builtin_modules.hpp"

namespace language {

/// A user module that is being evaluated.
struct Activation {
  const ModuleEntry* module;
  BlockEntry* block;          // null: no children
  HeapScope* block_scope;     // counted
  uint32_t block_activation;  // what children() means within the block
};

/// Owns the nodes that are open in the tree, and the activations of user modules.
class ModuleCalls {
 public:
  /// `names` are those of the user modules that run, outermost first.
  ModuleCalls(Compiler& compiler, ModuleEnvironment& environment,
              std::vector<std::string_view>& names, NodeTree& tree, CallStack& stack);

  void begin_node(const NodeSite& site) { begin_node(site.kind, site.modifiers, site.is_list); }
  void end_node(bool drop_if_empty);
  /// Removes the nodes that an aborted evaluation has left open, with all in them.
  void remove_open_nodes();
  /// Makes the node of a builtin module, and goes to `no_children` if it gets none.
  void make_node(const NodeSite& site, uint32_t no_children, bool takes_children);
  bool wants_first(const NodeSite& site);

  /// Counts a user module among those that run from here on.
  void add_name(Name name);
  /// Binds $parent_modules to how many of these there are.
  void bind_count();
  /// Keeps the scope around a block for the call of its module.
  void save_block() { block_scopes_.push_back(HeapScopes::acquire(stack_.scope())); }
  void call(const CallSite& site);
  void return_from_call();
  /// Returns the user module that the running code stands in; null: none.
  const Activation* activation() const;

  void say_successor(const NodeSite& site);
  void refuse_children(const NodeSite& site);
  void unknown_module(Name name);
  /// If the value that it pops is set, says that a parameter is overwritten with a literal.
  void pop_overwritten(Name parameter, Name module);

 private:
  /// A node that is open in the tree; or a list, which is none: its nodes belong to the node around
  /// it.
  struct OpenNode {
    uint32_t first;  // itself; of a list, the first of its nodes
    uint8_t modifiers;
    bool is_list;
  };

  void begin_node(NodeKind kind, uint8_t modifiers, bool is_list = false);
  void note_list();
  BuiltinCall builtin_call(const NodeSite& site, bool has_first);
  Value dynamic_value(Name name);

  Compiler& compiler_;
  ModuleEnvironment& environment_;
  std::vector<std::string_view>& names_;
  NodeTree& tree_;
  CallStack& stack_;
  const std::span<const BuiltinModule> builtins_;
  std::vector<OpenNode> open_nodes_;  // from outside in
  std::vector<Activation> activations_;
  std::vector<HeapScope*> block_scopes_;  // of blocks whose modules are about to be called
  const Name fragments_number_, fragments_angle_, fragments_size_;
  const Name fragments_error_;  // kNoName: it is not known
  const Name parent_modules_;
};

/// children() and child(), which run the children of a user module's call.
class Children {
 public:
  Children(Compiler& compiler, CallStack& stack, ModuleCalls& modules)
      : compiler_(compiler), stack_(stack), modules_(modules) {}

  /// Returns how many children the user module has that the running code stands in.
  uint32_t count() const;
  /// Begins a group, and runs all children in it.
  void run_all(const NodeSite& site);
  /// Ends the statement of a child. Returns true if the children that were to run have ended.
  bool end_child(bool is_last);

  // A selection takes three values on the stack: itself, how many are done, whether they go into a
  // group.

  /// Begins with the selection on top. Returns false after it has been refused, and dropped.
  bool select(const NodeSite& site, bool is_child);
  /// Runs the next child of the selection in some slot, or goes to `after`.
  void run_next(uint32_t slot, uint32_t after);
  void end_selection();
  /// Runs the children that the value on top selects in a group, or goes to `none`.
  void run_selection(const NodeSite& site, uint32_t none, bool is_child);
  void say_child_is_deprecated();

 private:
  bool is_child_number(int number, bool is_child);
  bool is_inside(int number);
  void refuse_type(const std::string& text, std::string_view end);
  std::optional<Value> numbers_of(const Value& selection);
  void append_existing(Value& numbers, const Value& selection);
  bool goes_to_next();
  static Value selected(const Value& selection, uint32_t done);
  void run(FrameKind kind, uint32_t child);

  Compiler& compiler_;
  CallStack& stack_;
  ModuleCalls& modules_;
};

}  // namespace language
