#include "lower/plates.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <unordered_map>
#include <utility>
#include <vector>

#include "subtrees/lowering.hpp"

namespace frontend {
namespace {

using csgcore::CsgTree;

class PlateThickener {
 public:
  PlateThickener(Collector& collected, Leaves& leaves, LeafBoxes& boxes)
      : collected_(collected), leaves_(leaves), boxes_(boxes) {}

  void thicken(Design& trees, bool makes_copies) {
    std::vector<bool> cuts(collected_.primitives.size());  // by the first primitive of a leaf
    for (const auto& [kind, tree] : trees.parts) {
      for (const LeafUse& use : uses_of_leaves(tree, boxes_.seen)) {
        if (use.is_subtracted) cuts[leaves_.first_primitive(use.leaf)] = true;
      }
    }
    std::vector<const Collector::WholeLeaf*> plates;
    for (const Collector::WholeLeaf& leaf : collected_.whole_leaves) {
      if (!leaf.is_plate || leaf.solid.empty()) continue;
      const uint32_t first = leaf.solid.tokens().front().value;
      if (!cuts[first]) continue;
      plates.push_back(&leaf);
      plate_of_[first] = &leaf;
    }
    if (plates.empty()) return;
    if (makes_copies) {
      for (auto& [kind, tree] : trees.parts) {
        tree = with_thin_copies(tree, trees.highlighted_leaves);
      }
    }
    for (const Collector::WholeLeaf* leaf : plates) {
      for (const csgcore::CsgToken& token : leaf->solid.tokens()) {
        if (!token.is_primitive) continue;
        thicken_plate(collected_.primitives[token.value], collected_.frames[leaf->frame].to_world);
      }
    }
  }

 private:
  LeafTree with_thin_copies(const LeafTree& tree, std::vector<uint32_t>& highlighted) {
    const std::vector<LeafUse> uses = uses_of_leaves(tree, boxes_.seen);
    auto use = uses.begin();
    return csgcore::renamed(tree, [&](uint32_t leaf) {
      const auto plate = plate_of_.find(leaves_.first_primitive(leaf));
      const bool is_thick = (use++)->is_subtracted;
      return is_thick || plate == plate_of_.end() ? leaf
                                                  : thin_copy(leaf, *plate->second, highlighted);
    });
  }

  uint32_t thin_copy(uint32_t leaf, const Collector::WholeLeaf& plate,
                     std::vector<uint32_t>& highlighted) {
    const auto [copy, is_new] = copies_.try_emplace(leaf, 0);
    if (!is_new) return copy->second;
    CsgTree solid = csgcore::renamed(plate.solid, [&](uint32_t primitive) {
      collected_.primitives.push_back(collected_.primitives[primitive]);
      return static_cast<uint32_t>(collected_.primitives.size()) - 1;
    });
    copy->second = leaves_.add(std::move(solid), plate.frame);
    boxes_.seen.push_back(boxes_.seen[leaf]);
    if (!boxes_.deciding.empty()) boxes_.deciding.push_back(boxes_.deciding[leaf]);
    // A copy is the last leaf: they stay ascending.
    if (std::binary_search(highlighted.begin(), highlighted.end(), leaf)) {
      highlighted.push_back(copy->second);
    }
    return copy->second;
  }

  Collector& collected_;
  Leaves& leaves_;
  LeafBoxes& boxes_;
  std::unordered_map<uint32_t, const Collector::WholeLeaf*> plate_of_;  // by first primitive
  std::unordered_map<uint32_t, uint32_t> copies_;                       // by leaf
};

}  // namespace

std::vector<csgcore::Box> boxes_of_thick_plates(double thickness, const Collector& collected,
                                                const Leaves& leaves,
                                                std::span<const csgcore::Box> boxes) {
  std::vector<csgcore::Box> result;
  if (thickness == 0) return result;
  std::unordered_map<uint32_t, uint32_t> frame_of;  // by the first primitive of a plate
  for (const Collector::WholeLeaf& leaf : collected.whole_leaves) {
    if (!leaf.is_plate || leaf.solid.empty()) continue;
    frame_of.emplace(leaf.solid.tokens().front().value, leaf.frame);
  }
  if (frame_of.empty()) return result;
  result.assign(boxes.begin(), boxes.end());
  for (uint32_t leaf = 0; leaf < result.size(); ++leaf) {
    const auto frame = frame_of.find(leaves.first_primitive(leaf));
    if (frame == frame_of.end() || result[leaf].empty()) continue;
    const csgcore::Affine& to_world = collected.frames[frame->second].to_world;
    const csgcore::Vec3 reach = thickness / 2 * glm::abs(to_world.linear[2]);
    result[leaf].min -= reach;
    result[leaf].max += reach;
  }
  return result;
}

void thicken_cutting_plates(PictureKind picture, Design& trees, Collector& collected,
                            Leaves& leaves, LeafBoxes& boxes) {
  PlateThickener(collected, leaves, boxes).thicken(trees, picture != PictureKind::kThrownTogether);
}

}  // namespace frontend
