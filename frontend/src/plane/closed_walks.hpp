// Arcs between numbered places, joined end to end.
#pragma once

#include <cstdint>
#include <vector>

namespace frontend {

struct Arc {
  uint64_t from, to;
};

/// Returns walks that come back to where they begin, by the places that each passes; together they
/// take each arc once. From every place there must be as many arcs as there are to it.
std::vector<std::vector<uint64_t>> closed_walks(std::vector<Arc> arcs);

}  // namespace frontend
