#include "render/eye_parts.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "lower/products.hpp"
#include "solids/leaves.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::CanonicalPrimitives;
using csgcore::CsgToken;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::Scene;

/// With more layers than this, those of coincident faces of which one starts a product and one ends
/// another need not be the last: a layer takes as long as a picture.
constexpr size_t kMostLayers = 32;

/// Finds the leaves in a tree over primitives (the inverse of Leaves::expanded).
class LeafFinder {
 public:
  LeafFinder(const Scene& scene, std::span<const CsgToken> tokens, Leaves& leaves)
      : tokens_(tokens), subtrees_(tokens), leaves_(leaves) {
    for (uint32_t root = 0; root < tokens.size(); ++root) {
      uint32_t leaf = tokens[root].value;
      if (tokens[root].is_primitive) {
        if (leaf < scene.leaf_of.size()) leaf = scene.leaf_of[leaf];
      } else {
        const std::vector<uint32_t> operands = subtrees_.operands(root);
        leaf = leaf_of_[operands.front()];
        for (const uint32_t operand : operands) {
          if (leaf_of_[operand] != leaf) leaf = kSeveral;
        }
      }
      leaf_of_.push_back(leaf);
    }
  }

  /// Returns the tree over leaves, having added the compound ones to the leaves.
  LeafTree tree() {
    CsgTreeBuilder builder;
    const auto last = static_cast<uint32_t>(tokens_.size()) - 1;
    if (tokens_.empty()) return builder.finish();
    if (leaf_of_[last] != kSeveral) {
      builder.primitive(leaf(Op::kUnion, {&last, 1}));
      return builder.finish();
    }
    struct Step {
      enum class Kind : uint8_t { kSubtree, kLeaf, kClose } kind;
      uint32_t value;
    };
    std::vector<Step> steps{{Step::Kind::kSubtree, last}};  // the next one last
    while (!steps.empty()) {
      const Step step = steps.back();
      steps.pop_back();
      if (step.kind == Step::Kind::kClose) builder.close();
      if (step.kind == Step::Kind::kLeaf) builder.primitive(step.value);
      if (step.kind != Step::Kind::kSubtree) continue;
      const Op op = tokens_[step.value].op;
      builder.open(op);
      steps.push_back({Step::Kind::kClose, 0});
      const std::vector<uint32_t> operands = subtrees_.operands(step.value);
      for (size_t end = operands.size(), begin; end > 0; end = begin) {
        // Adjacent operands of one leaf are that leaf.
        const uint32_t own = leaf_of_[operands[end - 1]];
        for (begin = end - 1; begin > 0 && own != kSeveral; --begin) {
          if (leaf_of_[operands[begin - 1]] != own) break;
        }
        if (own == kSeveral) {
          steps.push_back({Step::Kind::kSubtree, operands[begin]});
        } else {
          const bool is_subtracted = op == Op::kDifference && begin > 0;
          steps.push_back(
              {Step::Kind::kLeaf, leaf(is_subtracted ? Op::kUnion : op,
                                       std::span(operands).subspan(begin, end - begin))});
        }
      }
    }
    return builder.finish();
  }

 private:
  static constexpr uint32_t kSeveral = 0xFFFFFFFFu;

  /// Returns the leaf that is an operation on these subtrees.
  uint32_t leaf(Op op, std::span<const uint32_t> roots) {
    if (roots.size() == 1 && tokens_[roots[0]].is_primitive) return tokens_[roots[0]].value;
    CsgTreeBuilder builder;
    builder.open(op);
    for (const uint32_t root : roots) add_tree(subtrees_.tokens(root), builder);
    builder.close();
    return leaves_.add(builder.finish(), 0);
  }

  std::span<const CsgToken> tokens_;
  CsgSubtrees subtrees_;
  Leaves& leaves_;
  std::vector<uint32_t> leaf_of_;  // by root: that all its primitives are of, or kSeveral
};

/// Returns OpenSCAD's products of a tree over primitives.
std::vector<CsgTree> products(const Scene& scene, const CanonicalPrimitives& primitives,
                              const CsgTree& tree) {
  Leaves leaves(static_cast<uint32_t>(primitives.size()));
  const LeafTree over_leaves = LeafFinder(scene, tree.tokens(), leaves).tree();
  std::vector<Box> boxes;
  for (const csgcore::CanonicalPrimitive& primitive : primitives) boxes.push_back(primitive.bounds);
  for (uint32_t leaf = static_cast<uint32_t>(primitives.size()); leaf < leaves.size(); ++leaf) {
    boxes.push_back(box_of_positive_leaves(leaves.solid(leaf), boxes));
  }
  std::vector<CsgTree> result;
  for (Product& product : products_of(over_leaves, boxes, [](uint32_t) { return true; }).list) {
    result.push_back(leaves.expanded(std::move(product.solid)));
  }
  return result;
}

}  // namespace

EyeParts::EyeParts(const Scene& scene, std::shared_ptr<const CanonicalPrimitives> primitives,
                   csgcore::Layer::Kind kind, const CsgTree& tree)
    : primitives_(std::move(primitives)), kind_(kind) {
  for (CsgTree& product : products(scene, *primitives_, tree)) {
    csgcore::Blist list = csgcore::compile(product);
    products_.push_back({std::move(product), std::move(list)});
  }
}

std::vector<bool> EyeParts::products_that_hold(const csgcore::Vec3& eye) const {
  std::vector<bool> result;
  for (const Product& product : products_) {
    result.push_back(csgcore::evaluate(product.list.tests, [&](uint32_t primitive) {
      return csgcore::contains((*primitives_)[primitive], eye);
    }));
  }
  return result;
}

void EyeParts::make_layers(const std::vector<bool>& holding) {
  layers_.clear();
  if (products_.size() < 2) return;
  // Of products that hold the eye, the nearest end is that of their intersection; of others, the
  // nearest start is that of their union.
  std::vector<size_t> starts{0, products_.size()};  // of those that are one layer
  for (size_t i = 1; i < products_.size() && starts.size() <= kMostLayers + 1; ++i) {
    if (holding[i] != holding[i - 1]) starts.insert(starts.end() - 1, i);
  }
  PartSolids no_parts(*primitives_);
  const auto add_layer = [&](bool holds, size_t begin, size_t end) {
    CsgTreeBuilder builder;
    builder.open(holds ? Op::kIntersection : Op::kUnion);
    for (size_t i = begin; i < end; ++i) {
      if (holding[i] == holds) add_tree(products_[i].solid.tokens(), builder);
    }
    builder.close();
    layers_.push_back(std::make_unique<const PreparedLayer>(
        *primitives_, csgcore::Layer{kind_, false, builder.finish()}, no_parts));
  };
  if (starts.size() > kMostLayers + 1) {
    add_layer(false, 0, products_.size());
    add_layer(true, 0, products_.size());
    return;
  }
  for (size_t i = 0; i + 1 < starts.size(); ++i) {
    add_layer(holding[starts[i]], starts[i], starts[i + 1]);
  }
}

}  // namespace frontend
