// Which program evaluates a .scad.
#pragma once

#include <cstdint>

namespace frontend {

enum class Evaluator : uint8_t {
  kOwn,       // frontend/language
  kOpenScad,  // the installed openscad
};

/// What the command has a design evaluated by unless --evaluator says otherwise.
constexpr Evaluator kDefaultEvaluator = Evaluator::kOwn;

}  // namespace frontend
