#include "frontend/model_export.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <variant>

#include "arguments/node_problems.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/stop_scope.hpp"
#include "csgcore/workers.hpp"
#include "export/colored_parts.hpp"
#include "export/framed_boundary.hpp"
#include "export/model_writers.hpp"
#include "export/written_mesh.hpp"
#include "frontend/render_settings.hpp"
#include "language/color_names.hpp"
#include "plane/figure.hpp"
#include "solids/leaves.hpp"
#include "solids/triangles_of.hpp"

namespace frontend {
namespace {

using csgcore::Color;
using csgcore::TriangleSet;

/// Returns the colour in steps of 1/255, as files have it. A channel that color() has left open is
/// that of the default scheme.
Color written_color(const Color& color) {
  const Rgb front = RenderSettings{}.scheme.front;
  const auto channel = [](float value, uint8_t otherwise) {
    return (value >= 0 ? std::round(255 * std::min(value, 1.0f)) : static_cast<float>(otherwise)) /
           255;
  };
  return {channel(color.r, front.r), channel(color.g, front.g), channel(color.b, front.b),
          channel(color.a, 255)};
}

Polygons outlines_of(const ImportedDesign& design) {
  Polygons outlines;
  for (const std::vector<csgcore::Vec3>& outline : design.flat_outlines) {
    outlines.emplace_back(outline.begin(), outline.end());
  }
  return outlines;
}

csgcore::Box box_of(const TriangleSet& surface) {
  csgcore::Box box;
  for (const csgcore::Vec3& vertex : surface.vertices) box.merge(vertex);
  return box;
}

/// Returns null if the primitive is none.
const csgcore::Polyhedron* polyhedron_of(const csgcore::Primitive& primitive) {
  const auto* const shape = std::get_if<csgcore::PolyhedronShape>(&primitive.solid);
  return shape ? shape->polyhedron.get() : nullptr;
}

std::string encoded(const TriangleSet& surface, ModelFormat format) {
  switch (format) {
    case ModelFormat::kAsciiStl:
      return ascii_stl_of(surface);
    case ModelFormat::kOff:
      return off_of(surface);
    case ModelFormat::kObj:
      return obj_of(surface);
    case ModelFormat::kAmf:
      return amf_of(surface);
    default:
      return stl_of(surface);
  }
}

std::string encoded(const Polygons& outlines, ModelFormat format, const ExportSettings& settings) {
  switch (format) {
    case ModelFormat::kDxf:
      return dxf_of(outlines);
    case ModelFormat::kPdf:
      return pdf_of(outlines, settings);
    default:
      return svg_of(outlines, settings);
  }
}

/// Returns whether the polygon, which does not cross itself, turns to one side at every corner.
bool is_convex(const Polygon& polygon) {
  const double side = signed_area(polygon) < 0 ? -1 : 1;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const Vec2 c = polygon[(i + 2) % polygon.size()];
    if (side * ((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x)) < 0) return false;
  }
  return true;
}

ModelFigures figures_of(const Polygons& outlines) {
  ModelFigures figures{.is_plane = true, .outlines = outlines.size()};
  for (const Polygon& outline : outlines) {
    figures.area += signed_area(outline);  // holes run the other way
    for (const Vec2& point : outline) figures.box.merge({point.x, point.y, 0});
  }
  figures.area = std::abs(figures.area);
  figures.is_convex = outlines.size() == 1 && is_convex(outlines.front());
  return figures;
}

ModelFigures figures_of(const TriangleSet& surface) {
  ModelFigures figures{.box = box_of(surface),
                       .vertices = surface.vertices.size(),
                       .triangles = surface.triangles.size(),
                       .is_closed = csgcore::open_edges(surface) == 0};
  for (const std::array<uint32_t, 3>& t : surface.triangles) {
    const csgcore::Vec3& origin = surface.vertices[t[0]];
    figures.area +=
        glm::length(glm::cross(surface.vertices[t[1]] - origin, surface.vertices[t[2]] - origin)) /
        2;
  }
  return figures;
}

}  // namespace

ImportOptions options_for_export(ImportOptions options) {
  options.picture = PictureKind::kRendered;
  options.facets = Facets::kAll;
  options.keeps_colors = true;
  options.keeps_places = true;
  options.keeps_frames = true;
  options.measures_leaves = false;
  return options;
}

ModelExport::ModelExport(const ImportedDesign& design, const DesignTree& tree, unsigned threads,
                         ExportSettings settings)
    : design_(design), tree_(tree), threads_(threads), settings_(std::move(settings)) {}

void ModelExport::check(ModelFormat format) const {
  const auto fail = [&](const char* what) { throw Error(tree_.name, {}, what, ""); };
  const bool is_plane = design_.is_plane_figure;
  if (is_plane_format(format)) {
    if (design_.is_tangle) {
      throw Error(tree_.name, {}, "the edges of the plane figure cross too often",
                  "cut it into parts");
    }
    if (design_.flat_outlines.empty()) fail("Current top level object is not a 2D object.");
  } else {
    if (is_plane) fail("Current top level object is not a 3D object.");
    if (design_.scene.model.empty()) fail("Current top level object is empty.");
  }
}

std::string ModelExport::encode(ModelFormat format) {
  check(format);
  const csgcore::ThreadLimit limit(threads_);
  if (is_plane_format(format)) return encoded(outlines_of(design_), format, settings_);
  if (format == ModelFormat::k3mf) {
    std::vector<ExportedPart> written;
    for (const ExportedPart& part : colored_parts()) {
      TriangleSet rounded = written_mesh(part.surface, Precision::kFloat, tree_.name);
      if (!rounded.triangles.empty()) written.push_back({std::move(rounded), part.color});
    }
    if (written.empty()) fail_as_too_small();
    return three_mf_of(written, settings_);
  }
  const Precision precision = format == ModelFormat::kOff ? Precision::kDouble : Precision::kFloat;
  const TriangleSet rounded = written_mesh(surface(), precision, tree_.name);
  if (rounded.triangles.empty()) fail_as_too_small();
  return encoded(rounded, format);
}

void ModelExport::fail_as_too_small() const {
  throw Error(tree_.name, {}, "nothing is left of the solid in the numbers of this format",
              "scale it up");
}

/// Makes the operands' surfaces. A primitive whose surface is open is left out, since it is no
/// solid; but a design that is nothing else is written as it is.
void ModelExport::find_operands() {
  if (std::exchange(has_operands_, true)) return;
  const csgcore::Scene& scene = design_.scene;
  const std::vector<uint32_t> used = primitives_of(scene.model.tokens());
  operands_.resize(scene.primitives.size());
  std::vector<char> is_open(operands_.size());
  // Polyhedra that many primitives share are divided into triangles once.
  std::unordered_map<const csgcore::Polyhedron*, TriangleSet> hulls;
  for (const uint32_t primitive : used) {
    if (const csgcore::Polyhedron* shape = polyhedron_of(scene.primitives[primitive])) hulls[shape];
  }
  std::vector<decltype(hulls)::value_type*> entries;
  for (auto& entry : hulls) entries.push_back(&entry);
  const auto for_each = [stop = csgcore::stop_of_work](size_t count, const auto& make) {
    tbb::parallel_for(size_t{0}, count, [&](size_t i) {
      const csgcore::StopScope scope(stop);
      csgcore::stop_point();
      make(i);
    });
  };
  for_each(entries.size(), [&](size_t i) {
    auto& [shape, surface] = *entries[i];
    surface = triangles_of_hull(shape->vertices());
  });
  for_each(used.size(), [&](size_t i) {
    const csgcore::Primitive& primitive = scene.primitives[used[i]];
    TriangleSet& surface = operands_[used[i]];
    if (const csgcore::Polyhedron* shape = polyhedron_of(primitive)) {
      surface = hulls.at(shape);
      place(surface, primitive.local_to_world);
    } else {
      surface = triangles_of(primitive);
      is_open[used[i]] = csgcore::open_edges(surface) > 0;
    }
  });
  const bool is_alone = used.size() == 1 && is_open[used.front()];
  // A node of several primitives is there if one of them is: others are sheets that pictures have.
  std::vector<bool> is_there(design_.places.size(), false);
  const auto id_of = [&](uint32_t primitive) { return scene.primitives[primitive].id; };
  for (const uint32_t primitive : used) {
    if (!is_open[primitive] && id_of(primitive) < is_there.size())
      is_there[id_of(primitive)] = true;
  }
  NodeProblems problems;
  for (const uint32_t primitive : used) {
    const uint32_t id = id_of(primitive);
    if (!is_open[primitive] || id >= is_there.size() || is_there[id]) continue;
    problems.add(tree_.nodes->nodes[design_.places[id]],
                 {is_alone ? " is written as it is, which is no solid"
                           : " is left out of the file: it is no solid",
                  "close its surface"});
  }
  warnings_ = problems.warnings(tree_);
  if (is_alone) {
    surface_ = std::move(operands_[used.front()]);
    parts_ = {{*surface_, {}}};
    return;
  }
  csgcore::CsgTreeBuilder builder;
  rebuild(scene.model.tokens(), builder, [&](csgcore::CsgTreeBuilder& to, uint32_t primitive) {
    is_open[primitive] ? to.empty() : to.primitive(primitive);
  });
  solid_ = builder.finish();
}

const TriangleSet& ModelExport::surface_or_nothing() {
  find_operands();
  if (!surface_) surface_ = boundary_of(solid_);
  return *surface_;
}

TriangleSet ModelExport::boundary_of(const csgcore::CsgTree& tree) {
  if (!primitives_) primitives_ = csgcore::canonical_primitives(design_.scene);
  return framed_boundary(operands_, csgcore::without_redundant_operands(*primitives_, tree),
                         design_.turned_frames);
}

const TriangleSet& ModelExport::surface() {
  if (surface_or_nothing().triangles.empty()) {
    throw Error(tree_.name, {}, "Current top level object is empty.", "");
  }
  return *surface_;
}

std::optional<ModelFigures> ModelExport::figures() {
  if (!design_.flat_outlines.empty()) return figures_of(outlines_of(design_));
  if (design_.is_plane_figure || design_.scene.model.empty()) return std::nullopt;
  const csgcore::ThreadLimit limit(threads_);
  const TriangleSet mesh = written_mesh(surface_or_nothing(), Precision::kDouble, tree_.name);
  if (mesh.triangles.empty()) return std::nullopt;
  return figures_of(mesh);
}

std::vector<ExportedPart> ModelExport::colored_parts() {
  if (settings_.three_mf_colors == "model") return parts();
  ExportedPart whole{surface(), {}};
  const auto color = language::color_of_name(settings_.three_mf_color);
  if (settings_.three_mf_colors == "selected-only" && color) {
    whole.color = Color{(*color)[0], (*color)[1], (*color)[2], (*color)[3]};
  }
  return {whole};
}

const std::vector<ExportedPart>& ModelExport::parts() {
  find_operands();
  if (parts_) return *parts_;
  std::vector<csgcore::Box> boxes;
  for (const TriangleSet& operand : operands_) boxes.push_back(box_of(operand));
  const auto color_of = [&](uint32_t primitive) -> std::optional<Color> {
    const std::optional<Color>& color = design_.scene.primitives[primitive].color;
    return color ? std::optional(written_color(*color)) : std::nullopt;
  };
  std::vector<ColoredTree> trees = colored_trees(solid_, boxes, color_of);
  parts_.emplace();
  if (trees.size() == 1) {
    parts_->push_back({surface(), trees.front().color});
    return *parts_;
  }
  for (const ColoredTree& part : trees) {
    TriangleSet surface = boundary_of(part.tree);
    if (!surface.triangles.empty()) parts_->push_back({std::move(surface), part.color});
  }
  if (parts_->empty()) throw Error(tree_.name, {}, "Current top level object is empty.", "");
  return *parts_;
}

}  // namespace frontend
