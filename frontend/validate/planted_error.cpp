#include "planted_error.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "frontend/error.hpp"

namespace validation {
namespace {

using csgcore::CsgToken;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;

/// Adds a tree's operations to a builder. Returns whether the primitive is cut away: it stands
/// below an odd number of cuts.
bool add_tree(const CsgTree& tree, uint32_t primitive, CsgTreeBuilder& builder) {
  const auto tokens = tree.tokens();
  std::vector<std::size_t> first(tokens.size());  // the first token of each token's subtree
  std::vector<std::size_t> open;                  // subtrees that no operation has taken yet
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    first[i] = i;
    if (!tokens[i].is_primitive) {
      open.resize(open.size() - (tokens[i].value - 1));
      first[i] = first[open.back()];
      open.pop_back();
    }
    open.push_back(i);
  }
  struct Visit {
    std::size_t token;
    bool is_cut;
    bool closes;
  };
  bool is_cut = false;
  std::vector<Visit> stack;
  if (!tokens.empty()) stack.push_back({tokens.size() - 1, false, false});
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    const CsgToken& token = tokens[visit.token];
    if (visit.closes) {
      builder.close();
    } else if (token.is_primitive) {
      builder.primitive(token.value);
      if (token.value == primitive) is_cut = visit.is_cut;
    } else {
      builder.open(token.op);
      stack.push_back({visit.token, visit.is_cut, true});
      // The last operand is pushed first.
      for (std::size_t n = token.value, end = visit.token; n > 0; --n) {
        const std::size_t operand = end - 1;
        const bool cuts = token.op == Op::kDifference && n > 1;
        stack.push_back({operand, visit.is_cut != cuts, false});
        end = first[operand];
      }
    }
  }
  return is_cut;
}

CsgTree flipped(const CsgTree& tree, uint32_t primitive) {
  CsgTreeBuilder ignored;
  const bool is_cut = add_tree(tree, primitive, ignored);
  CsgTreeBuilder builder;
  builder.open(is_cut ? Op::kUnion : Op::kDifference);
  add_tree(tree, primitive, builder);
  builder.primitive(primitive);
  builder.close();
  return builder.finish();
}

}  // namespace

csgcore::Scene with_planted_error(const csgcore::Scene& scene, const std::string& error) {
  csgcore::Scene result = scene;
  uint32_t id = 0;
  double distance = 0;
  const bool is_flip = std::sscanf(error.c_str(), "flip:%u", &id) == 1;
  const bool is_move = std::sscanf(error.c_str(), "move:%u:%lf", &id, &distance) == 2;
  const auto primitive = std::find_if(result.primitives.begin(), result.primitives.end(),
                                      [id](const auto& p) { return p.id == id; });
  if (!(is_flip || is_move) || primitive == result.primitives.end()) {
    throw frontend::Error("", {}, std::string(kPlantedErrorVariable) + "=" + error,
                          "give flip:K or move:K:DISTANCE with a primitive's id K");
  }
  if (is_move) {
    primitive->local_to_world.translation.x += distance;
  } else {
    result.model =
        flipped(scene.model, static_cast<uint32_t>(primitive - result.primitives.begin()));
  }
  return result;
}

}  // namespace validation
