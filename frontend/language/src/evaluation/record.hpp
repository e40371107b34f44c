// What an evaluation notes of a part of it that may be kept.
#pragma once

#include <cstddef>
#include <cstdint>

namespace language {

constexpr uint32_t kNoUnit = 0xFFFFFFFFu;

/// The evaluation of a used file's top level, or of a module's call. What it depends on stands in
/// the DependencyLog.
struct Record {
  uint32_t unit;      // whose top level it is; kNoUnit: a call of a module
  uint32_t trail;     // of `$` names, when it began
  uint64_t messages;  // that had been said by then
  size_t finds;       // of files until then
  uint64_t work;      // until then
  uint32_t modules;   // that run around it
  /// It has called no rands(), no parent_module() of those around it, and met nothing that only the
  /// first call of a run does. A top level has made no function value.
  bool is_pure = true;
  // What follows is known of a call only.
  uint64_t hash = 0;        // of the module and its arguments
  size_t frames = 0;        // whose number is that of its frame
  uint32_t first_node = 0;  // of the tree
  uint32_t first_call = 0;  // of those that are kept
};

}  // namespace language
