#include "csg/node_path.hpp"

namespace frontend {

std::vector<uint32_t> path_to(const language::NodeTree& tree, uint32_t node) {
  const uint32_t wanted = node + language::root_modifiers(tree).shown.value_or(0);
  std::vector<uint32_t> path;
  if (wanted >= tree.size()) return path;
  for (uint32_t i = 0; i <= wanted;) {
    const uint32_t end = tree.nodes[i].end;
    const bool is_around = end > wanted;
    if (is_around) path.push_back(i);
    i = is_around ? i + 1 : end;
  }
  return path;
}

}  // namespace frontend
