#include "subtrees/render_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/primitive_traits.hpp"
#include "csgcore/facets.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

/// A circle of 96 fragments is 1/7 of a pixel away from the round one if it is 512 pixels wide, one
/// of 36 a pixel.
constexpr std::array<int, 8> kFragments = {96, 72, 60, 48, 36, 24, 18, 12};
/// The facets, or pairs of facets in a sum, that openscad takes some three seconds for.
constexpr double kMostRenderedFacets = 2048;

/// A part whose facets are not counted, such as a text or a file, counts as so many.
constexpr double kFacetsOfOthers = 256;

struct RoundLeaf {
  bool is_round = false;
  bool is_kept = false;  // its facets are wanted
  csgcore::FacetSettings facets{};
  int own = 0;  // OpenSCAD's fragments
};

/// Returns the most fragments that a shape of any radius may have.
int most_fragments(const csgcore::FacetSettings& facets) {
  const double count = facets.fn > 0 ? facets.fn : std::ceil(360 / std::max(facets.fa, 0.01));
  return static_cast<int>(std::clamp(count, 3.0, 36000.0));
}

RoundLeaf round_leaf(const NodeTree& tree, const Node& node, const ImportOptions& options) {
  NodeProblems told;  // when the node was taken
  NodeReader reader(tree, node, told);
  RoundLeaf leaf;
  switch (node.kind) {
    case NodeKind::kSphere:
    case NodeKind::kCylinder:
    case NodeKind::kCircle: {
      const RoundNode round = chosen(
          options, node.kind == NodeKind::kCylinder ? read_cylinder(reader) : read_sphere(reader));
      leaf.is_round = csgcore::has_valid_shape(round.primitive);
      leaf.facets = round.facets;
      if (leaf.is_round) {
        leaf.own = traits_of(round.primitive.shape()).fragments(round.primitive, leaf.facets);
      }
      break;
    }
    case NodeKind::kRotateExtrude:
    case NodeKind::kOffset:
    case NodeKind::kText:
      leaf.is_round = true;
      leaf.facets = chosen(options, reader.facets());
      leaf.own = most_fragments(leaf.facets);
      break;
    default:
      return leaf;
  }
  leaf.is_kept = keeps_facets(options, leaf.facets);
  return leaf;
}

double facets_of(NodeKind kind, double fragments, double children) {
  switch (kind) {
    case NodeKind::kSphere:
      return fragments * fragments / 2;
    case NodeKind::kCylinder:
    case NodeKind::kCircle:
      return fragments + 2;
    case NodeKind::kCube:
    case NodeKind::kSquare:
      return 6;
    case NodeKind::kPolyhedron:
    case NodeKind::kPolygon:
    case NodeKind::kText:
    case NodeKind::kImport:
    case NodeKind::kSurface:
      return kFacetsOfOthers;
    case NodeKind::kRotateExtrude:
      return fragments * children;
    case NodeKind::kOffset:
      return fragments + children;
    default:
      return children;
  }
}

class FacetCount {
 public:
  FacetCount(const NodeTree& tree, uint32_t root, const ImportOptions& options)
      : tree_(tree), root_(root) {
    for (uint32_t i = root; i < tree.nodes[root].end; ++i) {
      leaves_.push_back(round_leaf(tree, tree.nodes[i], options));
    }
  }

  /// Returns the fragments of a node where at least so many are wanted.
  double fragments(uint32_t index, int wanted) const {
    const RoundLeaf& leaf = leaves_[index - root_];
    return leaf.is_kept ? leaf.own : std::max(leaf.own, wanted);
  }
  const RoundLeaf& leaf(uint32_t index) const { return leaves_[index - root_]; }

  /// Returns the facets of the whole, about.
  double total(int wanted) const {
    std::vector<double> facets(leaves_.size());
    // Children come after their parents.
    for (size_t i = facets.size(); i-- > 0;) {
      const auto index = root_ + static_cast<uint32_t>(i);
      const Node& node = tree_.nodes[index];
      const bool multiplies = node.kind == NodeKind::kMinkowski;
      double children = multiplies && node.end > index + 1 ? 1 : 0;
      for (uint32_t c = index + 1; c < node.end; c = tree_.nodes[c].end) {
        if ((tree_.nodes[c].modifiers & language::kBackgroundModifier) != 0) continue;
        const double of_child = facets[c - root_];
        children = multiplies ? children * std::max(of_child, 1.0) : children + of_child;
      }
      facets[i] = facets_of(node.kind, fragments(index, wanted), children);
    }
    return facets.front();
  }

 private:
  const NodeTree& tree_;
  const uint32_t root_;
  std::vector<RoundLeaf> leaves_;
};

}  // namespace

std::vector<double> render_fragments(const NodeTree& tree, uint32_t root,
                                     const ImportOptions& options) {
  const FacetCount count(tree, root, options);
  const auto* const wanted = std::ranges::find_if(
      kFragments, [&](int fragments) { return count.total(fragments) <= kMostRenderedFacets; });
  std::vector<double> result;
  for (uint32_t i = root; i < tree.nodes[root].end; ++i) {
    const RoundLeaf& leaf = count.leaf(i);
    double fn = 0;
    if (leaf.is_round && options.fn) fn = *options.fn;
    if (leaf.is_round && !leaf.is_kept && wanted != kFragments.end() && *wanted > leaf.own) {
      fn = *wanted;
    }
    result.push_back(fn);
  }
  return result;
}

}  // namespace frontend
