// Which program evaluates a .scad.
#pragma once

#include <cstdint>

namespace frontend {

enum class Evaluator : uint8_t {
  kOwn,       // frontend/language; openscad for what that does not know
  kOpenScad,  // the installed openscad
};

/// What a design is evaluated by unless --evaluator says otherwise.
constexpr Evaluator kDefaultEvaluator = Evaluator::kOpenScad;

}  // namespace frontend
