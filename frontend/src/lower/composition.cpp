#include "lower/composition.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_set>
#include <utility>

#include "lower/products.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::CutFaces;
using csgcore::Layer;
using csgcore::Scene;

class Composer {
 public:
  Composer(const Leaves& leaves, std::span<const Box> boxes, bool has_marked_faces, Scene& scene)
      : leaves_(leaves), boxes_(boxes), has_marked_faces_(has_marked_faces), scene_(scene) {}

  /// OpenSCAD's preview and its final render.
  void compose_preview(Design& design, PictureKind picture) {
    for (const auto& [kind, tree] : design.parts) {
      const bool is_opaque = picture == PictureKind::kRendered || !has_translucent(tree);
      if (kind != Layer::Kind::kModel || !is_opaque) add_products(tree, kind);
      if (leaves_.has_compound()) set_cut_faces(tree);
    }
    scene_.model = leaves_.expanded(std::move(design.parts.front().tree));
  }

  /// Every leaf of a product whole. Opaque leaves that follow one another are drawn at once.
  void compose_thrown_together(const Design& design) {
    std::vector<uint32_t> all, opaque;
    std::vector<Layer> layers;
    const auto end_opaque = [&] {
      if (opaque.empty()) return;
      layers.push_back({Layer::Kind::kModel, false, leaves_.expanded(union_of(opaque))});
      opaque.clear();
    };
    bool has_translucent = false, has_model = false;
    for (const LeafUse& use : leaves_of_products(design.model())) {
      set_cut_faces(use);
      all.push_back(use.leaf);
      if (use.is_subtracted && is_plate(use.leaf)) hidden_.insert(use.leaf);
      const bool is_highlighted = design.is_highlighted(use.leaf);
      const Layer::Kind kind = is_highlighted ? Layer::Kind::kHighlight : Layer::Kind::kModel;
      has_model = has_model || kind == Layer::Kind::kModel;
      if (is_opaque_leaf(use.leaf, kind)) {
        opaque.push_back(use.leaf);
        continue;
      }
      has_translucent = true;
      end_opaque();
      layers.push_back({kind, false, leaves_.expanded(union_of({&use.leaf, 1}))});
    }
    end_opaque();
    scene_.model = leaves_.expanded(union_of(all));
    // Without a layer of the model, all of it would be drawn before the others.
    if (has_translucent && !has_model) layers.insert(layers.begin(), Layer{});
    if (has_translucent) scene_.layers = std::move(layers);
    for (const DesignPart& part : std::span(design.parts).subspan(1)) add_leaves(design, part);
  }

  /// The final render is one mesh.
  void set_leaves(PictureKind picture) {
    const auto primitives = static_cast<uint32_t>(scene_.primitives.size());
    if (picture == PictureKind::kRendered) scene_.leaf_of.assign(primitives, 0);
    if (picture == PictureKind::kRendered || !leaves_.has_compound()) return;
    scene_.leaf_of.resize(primitives);
    std::iota(scene_.leaf_of.begin(), scene_.leaf_of.end(), 0u);
    for (uint32_t leaf = primitives; leaf < leaves_.size(); ++leaf) {
      for (const csgcore::CsgToken& token : leaves_.solid(leaf).tokens()) {
        if (token.is_primitive) scene_.leaf_of[token.value] = leaves_.first_primitive(leaf);
      }
    }
  }

  bool has_all_layers() const { return has_all_layers_; }

 private:
  bool is_opaque_leaf(uint32_t leaf, Layer::Kind kind) const {
    if (kind == Layer::Kind::kHighlight) return false;
    const auto is_opaque = [&](uint32_t primitive) {
      const std::optional<csgcore::Color>& color = scene_.primitives[primitive].color;
      return color ? color->a == 1 : kind == Layer::Kind::kModel;
    };
    if (!leaves_.is_compound(leaf)) return is_opaque(leaf);
    const auto tokens = leaves_.solid(leaf).tokens();
    return std::ranges::all_of(tokens, [&](const csgcore::CsgToken& token) {
      return !token.is_primitive || is_opaque(token.value);
    });
  }

  bool has_translucent(const LeafTree& tree) const {
    const auto tokens = tree.tokens();
    return std::any_of(tokens.begin(), tokens.end(), [&](const csgcore::CsgToken& token) {
      return token.is_primitive && !is_opaque_leaf(token.value, Layer::Kind::kModel);
    });
  }

  void add_products(const LeafTree& tree, Layer::Kind kind) {
    Products products =
        products_of(tree, boxes_, [&](uint32_t leaf) { return !is_opaque_leaf(leaf, kind); });
    has_all_layers_ = has_all_layers_ && !products.are_too_many;
    for (const Product& product : products.list) {
      Layer layer{kind, product.is_leaf && !product.is_opaque, leaves_.expanded(product.solid)};
      if (!product.is_leaf && !product.is_opaque && !products.are_too_many) {
        layer.parts = parts_of(product.solid);
      }
      scene_.layers.push_back(std::move(layer));
    }
  }

  /// OpenSCAD blends each leaf of a product wherever the depths of its surface are those that are
  /// seen, also where an earlier product has drawn them.
  std::vector<Layer::Part> parts_of(const LeafTree& product) const {
    std::vector<Layer::Part> parts;
    for (const LeafUse& use : uses_of_leaves(product, boxes_)) {
      parts.push_back({leaves_.expanded(union_of({&use.leaf, 1})), use.is_subtracted});
    }
    return parts;
  }

  /// A face's colour follows its leaf's sign, whatever the leaf is made of.
  void set_cut_faces(const LeafTree& tree) {
    for (const LeafUse& use : uses_of_leaves(tree, boxes_)) {
      if (leaves_.is_compound(use.leaf)) set_cut_faces(use);
    }
  }

  void set_cut_faces(const LeafUse& use) {
    const auto set = [&](uint32_t primitive) {
      CutFaces& cut_faces = scene_.primitives[primitive].cut_faces;
      if (has_marked_faces_ && cut_faces == CutFaces::kAlways) return;
      cut_faces = use.is_subtracted ? CutFaces::kAlways : CutFaces::kNever;
    };
    if (!leaves_.is_compound(use.leaf)) return set(use.leaf);
    for (const csgcore::CsgToken& token : leaves_.solid(use.leaf).tokens()) {
      if (token.is_primitive) set(token.value);
    }
  }

  /// The leaves of the tree's products, each once.
  std::vector<LeafUse> leaves_of_products(const LeafTree& tree) const {
    std::vector<LeafUse> result;
    std::unordered_set<uint32_t> taken;
    for (const Product& product : products_of(tree, boxes_, [](uint32_t) { return true; }).list) {
      for (const LeafUse& use : uses_of_leaves(product.solid, boxes_)) {
        if (use.meets_others && taken.insert(use.leaf).second) result.push_back(use);
      }
    }
    return result;
  }

  void add_leaves(const Design& design, const DesignPart& part) {
    for (const LeafUse& use : leaves_of_products(part.tree)) {
      if (hidden_.contains(use.leaf)) continue;
      const Layer::Kind own = design.is_highlighted(use.leaf) ? Layer::Kind::kHighlight : part.kind;
      // OpenSCAD draws the faces of these parts in their order: those of a plate from below.
      scene_.layers.push_back(
          {own, is_plate(use.leaf), leaves_.expanded(union_of({&use.leaf, 1}))});
    }
  }

  /// Returns whether the leaf is a plane figure that is seen from above, or a flat solid.
  bool is_plate(uint32_t leaf) const { return boxes_[leaf].size().z == 0; }

  static LeafTree union_of(std::span<const uint32_t> leaves) {
    csgcore::CsgTreeBuilder builder;
    for (const uint32_t leaf : leaves) builder.primitive(leaf);
    return builder.finish();
  }

  const Leaves& leaves_;
  std::span<const Box> boxes_;
  const bool has_marked_faces_;
  Scene& scene_;
  bool has_all_layers_ = true;
  /// Plates that are subtracted, which are thicker as such than as what is drawn over them.
  std::unordered_set<uint32_t> hidden_;
};

/// Returns the box around those of a tree's products. That of a product is the intersection of
/// the boxes of its operands but for those that are subtracted.
Box box_of_products(const LeafTree& tree, std::span<const Box> boxes) {
  constexpr size_t kMostBoxes = 1024;  // of an operand: if it has more products, theirs is one
  const auto intersect = [](std::span<const Box> a, std::span<const Box> b) {
    std::vector<Box> both;
    for (const Box& left : a) {
      for (const Box& right : b) {
        const Box box = csgcore::intersection(left, right);
        if (!box.empty()) both.push_back(box);
      }
    }
    if (both.size() > kMostBoxes) both = {box_around(both)};
    return both;
  };
  std::vector<Box> products;   // of the operands that no operation has taken, one after another
  std::vector<size_t> begins;  // of these operands
  for (const csgcore::CsgToken& token : tree.tokens()) {
    if (token.is_primitive) {
      begins.push_back(products.size());
      products.push_back(boxes[token.value]);
      continue;
    }
    const size_t first = begins.size() - token.value;
    const size_t begin = begins[first];
    begins.push_back(products.size());  // the last operand's end
    if (token.op == csgcore::Op::kDifference) products.resize(begins[first + 1]);
    if (token.op == csgcore::Op::kIntersection) {
      const std::span<const Box> all(products);
      const auto operand = [&](size_t i) {
        return all.subspan(begins[first + i], begins[first + i + 1] - begins[first + i]);
      };
      std::vector<Box> both(operand(0).begin(), operand(0).end());
      for (size_t i = 1; i < token.value; ++i) both = intersect(both, operand(i));
      products.resize(begin);
      products.insert(products.end(), both.begin(), both.end());
    }
    begins.resize(first + 1);
    if (products.size() - begin > kMostBoxes) {
      products[begin] = box_around(std::span<const Box>(products).subspan(begin));
      products.resize(begin + 1);
    }
  }
  return box_around(products);
}

}  // namespace

Box box_around(std::span<const Box> boxes) {
  Box result;
  for (const Box& box : boxes) result.merge(box);
  return result;
}

bool Design::is_highlighted(uint32_t leaf) const {
  return std::binary_search(highlighted_leaves.begin(), highlighted_leaves.end(), leaf);
}

bool compose(Design design, const Leaves& leaves, std::span<const Box> boxes, PictureKind picture,
             bool has_marked_faces, Scene& scene) {
  Composer composer(leaves, boxes, has_marked_faces, scene);
  composer.set_leaves(picture);
  if (picture == PictureKind::kThrownTogether) {
    composer.compose_thrown_together(design);
  } else {
    composer.compose_preview(design, picture);
  }
  return composer.has_all_layers();
}

Box view_box(const Design& design, std::span<const Box> boxes, bool intersects_boxes) {
  Box result;
  for (const auto& [kind, tree] : design.parts) {
    result.merge(intersects_boxes ? box_of_products(tree, boxes)
                                  : box_of_positive_leaves(tree, boxes));
  }
  return result;
}

}  // namespace frontend
