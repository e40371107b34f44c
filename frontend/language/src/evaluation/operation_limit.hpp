// Limits what one operation on values may make.
#pragma once

#include <algorithm>
#include <cstdint>

#include "values/object_memory.hpp"

namespace language {

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

}  // namespace language
