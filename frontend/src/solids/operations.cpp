#include "solids/operations.hpp"

#include <cstddef>
#include <span>

#include "plane/outlines.hpp"

namespace frontend {

using csgcore::CsgToken;

std::optional<std::vector<Figure>> outcome_of(const Operations<Figure>& operations) {
  std::vector<Figure> result;
  if (operations.is_union()) {
    for (const CsgToken& token : operations.tree.tokens()) {
      if (token.is_primitive) result.push_back(operations.parts[token.value]);
    }
    return result;
  }
  std::vector<SimplePolygons> done;  // of the subtrees that no operation has taken
  for (const CsgToken& token : operations.tree.tokens()) {
    std::optional<SimplePolygons> polygons;
    if (token.is_primitive) {
      polygons = united(std::span(&operations.parts[token.value], 1));
    } else {
      const auto first = done.end() - static_cast<std::ptrdiff_t>(token.value);
      polygons = combined(token.op, std::span(first, done.end()));
      done.erase(first, done.end());
    }
    if (!polygons) return std::nullopt;
    done.push_back(std::move(*polygons));
  }
  if (!done.back().empty()) result.push_back(outline_of(std::move(done.back())));
  return result;
}

}  // namespace frontend
