// The texts that the panels show and that are not the program's own.
#pragma once

#include <functional>
#include <string_view>

#include "state.hpp"

namespace window {

void visit_texts(const State& state, const std::function<void(std::string_view)>& visit);

}  // namespace window
