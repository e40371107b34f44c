// What is thrown where an evaluation is stopped from outside.
#pragma once

#include <exception>

namespace language {

class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped"; }
};

}  // namespace language
