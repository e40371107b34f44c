#include "solids/solid_value.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/primitive_traits.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "solids/faceted_box.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::Vec3;

template <typename Points>
Box box_of_points(const Affine& map, const Points& points) {
  Box box;
  for (const Vec3& point : points) box.merge(map.point(point));
  return box;
}

/// More fragments have the round solid's box, as far as a picture shows.
constexpr int kMostFragments = 180;

/// The box of OpenSCAD's corners, whatever the matrix is.
Box box_of(const Primitive& primitive, const csgcore::FacetSettings& facets) {
  const Affine& map = primitive.local_to_world;
  if (is_axis_aligned(map)) return faceted_box(primitive, facets);
  if (primitive.polyhedron()) return box_of_points(map, primitive.polyhedron()->vertices());
  if (primitive.mesh()) return box_of_points(map, primitive.mesh()->vertices());
  const int fragments =
      std::min(kMostFragments, traits_of(primitive.shape()).fragments(primitive, facets));
  if (fragments == 0) return faceted_box(primitive, facets);
  return box_of_points(map, csgcore::faceted_mesh(primitive, fragments).vertices);
}

/// The half-lengths of a generator's round parts along each axis.
Vec3 reach_of(const Generator& generator) {
  Vec3 reach;
  for (int axis = 0; axis < 3; ++axis) {
    reach[axis] =
        std::hypot(generator.disc_a[axis], generator.disc_b[axis]) +
        std::hypot(generator.ball[0][axis], generator.ball[1][axis], generator.ball[2][axis]);
  }
  return reach;
}

Box box_of(const Generators& generators) {
  Box box;
  for (const Generator& generator : generators) {
    const Vec3 reach = reach_of(generator);
    box.merge(generator.center - reach);
    box.merge(generator.center + reach);
  }
  return box;
}

}  // namespace

bool SolidPart::is_convex() const { return !primitive || frontend::is_convex(*primitive); }

void SolidPart::add_support(SupportSet& support) const {
  if (primitive) {
    support.is_faceted = support.is_faceted || is_faceted;
    frontend::add_support(*primitive, support);
    return;
  }
  support.is_faceted = support.is_faceted || body.is_faceted;
  support.generators.insert(support.generators.end(), body.generators.begin(),
                            body.generators.end());
}

void SolidPart::map(const Affine& map) {
  if (primitive) {
    primitive->local_to_world = compose(map, primitive->local_to_world);
    box = is_axis_aligned(map) ? mapped(map, box) : box_of(*primitive, facets);
    return;
  }
  map_all(map, body.generators);
  box = is_axis_aligned(map) ? mapped(map, box) : box_of(body.generators);
}

SolidPart part_of(Primitive primitive, const csgcore::FacetSettings& facets) {
  SolidPart part;
  part.box = box_of(primitive, facets);
  part.primitive = std::move(primitive);
  part.facets = facets;
  return part;
}

SolidPart faceted_part(Primitive mesh, bool is_smooth) {
  SolidPart part = part_of(std::move(mesh), {});
  part.is_faceted = is_smooth;
  return part;
}

SolidPart part_of(SupportSet body, const Box& box) {
  SolidPart part;
  part.box = box.empty() ? box_of(body.generators) : box;
  part.body = std::move(body);
  return part;
}

std::vector<SolidValue> operands_of_union(const SolidValue& value) {
  const std::span<const csgcore::CsgToken> tokens = value.tree.tokens();
  std::vector<SolidValue> result;
  if (tokens.empty()) return result;
  const CsgSubtrees subtrees(tokens);
  const auto last = static_cast<uint32_t>(tokens.size()) - 1;
  const bool is_union = !tokens[last].is_primitive && tokens[last].op == Op::kUnion;
  for (const uint32_t root : is_union ? subtrees.operands(last) : std::vector{last}) {
    SolidValue& operand = result.emplace_back();
    CsgTreeBuilder builder;
    rebuild(subtrees.tokens(root), builder, [&](CsgTreeBuilder& to, uint32_t part) {
      to.primitive(static_cast<uint32_t>(operand.parts.size()));
      operand.parts.push_back(value.parts[part]);
    });
    operand.tree = builder.finish();
  }
  return result;
}

}  // namespace frontend
