// What the machine knows of each call that it is in.
#pragma once

#include <cstdint>

#include "base/name_table.hpp"
#include "code/code.hpp"
#include "evaluation/heap_scope.hpp"

namespace language {

enum class FrameKind : uint8_t {
  kFunction,
  kDefaults,         // the defaults of a call, which are left in its slots
  kDynamicDefaults,  // … or packed into a vector, in the slot below
  kModule,
  kBlock,     // all children of a block
  kChild,     // one of them
  kUnit,      // the assignments of a used file's top level
  kMainUnit,  // … of the main file's
};

constexpr uint32_t kNoActivation = 0xFFFFFFFFu;

struct Frame {
  const Code* code;
  uint32_t next;        // the instruction that comes next
  uint32_t base;        // of its slots in the stack
  HeapScope* scope;     // the innermost one; counted
  uint32_t trail;       // its length when the frame was made
  uint32_t activation;  // of the user module that the code stands in, or kNoActivation
  int64_t memory;       // that values took when the frame was made, in bytes
  uint32_t rounds = 0;  // of tail calls
  const FunctionEntry* function = nullptr;
  Name called_as = kNoName;  // of a function value: the name in its call
  Place call{};              // of a function value
  FrameKind kind = FrameKind::kFunction;
};

/// A user module that is being evaluated.
struct Activation {
  const ModuleEntry* module;
  BlockEntry* block;          // null: no children
  HeapScope* block_scope;     // counted
  uint32_t block_activation;  // what children() means within the block
};

}  // namespace language
