// What ends an evaluation early.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <stop_token>
#include <utility>

#include "language/node_tree.hpp"
#include "language/stopped.hpp"
#include "values/object_memory.hpp"

namespace language {

/// Thrown where the evaluation of a design ends early; its error has been said.
class Aborted : public std::exception {
 public:
  const char* what() const noexcept override { return "aborted"; }
};

/// Thrown by the sink of messages at a warning, if warnings end the evaluation.
class HardWarning : public std::exception {
 public:
  const char* what() const noexcept override { return "warning"; }
};

/// As long as it lives, the values of this thread's evaluation may grow by no more than one
/// operation has reason to: by six million numbers. Vectors that hold one another many times take
/// little memory, but what an operator or a builtin function makes of them has no end.
class OperationLimit {
 public:
  OperationLimit() {
    constexpr int64_t kMostBytes = int64_t{96} << 20;
    object_memory.limit = std::min(object_memory.limit, object_memory.used + kMostBytes);
  }
  ~OperationLimit() { object_memory.limit = before_; }
  OperationLimit(const OperationLimit&) = delete;
  OperationLimit& operator=(const OperationLimit&) = delete;

 private:
  int64_t before_ = object_memory.limit;
};

/// Counts the steps of an evaluation (calls, rounds, nodes), and looks from time to time whether it
/// has to stop.
class StepCount {
 public:
  /// The tree is the one that grows while the steps are counted.
  StepCount(std::stop_token stop, const NodeTree& tree) : stop_(std::move(stop)), tree_(tree) {}

  /// Counts a step. Throws Stopped, and OutOfValueMemory if the tree is too large.
  void count() {
    if (--left_ == 0) look();
  }
  /// Counts a step and returns true, unless the step is one at which to look.
  bool count_without_look() {
    if (left_ <= 1) return false;
    --left_;
    return true;
  }

 private:
  void look() {
    // Well below the 50 ms in which an evaluation has to stop.
    constexpr uint32_t kStepsPerLook = 4096;
    left_ = kStepsPerLook;
    if (stop_.stop_requested()) throw Stopped();
    if (tree_.bytes() > static_cast<size_t>(object_memory.limit)) throw OutOfValueMemory();
  }

  std::stop_token stop_;
  const NodeTree& tree_;
  uint32_t left_ = 1;  // until the next look
};

}  // namespace language
