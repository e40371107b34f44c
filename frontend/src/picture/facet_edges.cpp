#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "picture/edge_overlay.hpp"
#include "picture/overlay_lines.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::Primitive;
using csgcore::Vec3;
using csgcore::View;

/// A line fades out over so many pixels on each of its sides. They are counted along x and y
/// together, so that an oblique line is wider: so OpenSCAD's shader does.
constexpr double kFade_px = 1.41;
/// The tolerance for an edge that lies in the plane of a face: positions are floats, a renderer's
/// may be off by a few ulp, and vertices have the digits of their file.
constexpr double kInFace = 3e-5;  // share of the distance from the eye

/// The least distance to a line of the pixels that it goes through is no more than this.
constexpr double kCore_px = 0.5;

/// Returns 1 on the line, and 0 from kFade_px on.
double strength_at(double distance_px) {
  const double t = std::clamp(distance_px / kFade_px, 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

/// The same of a line that is to be seen: one whose pixels keep nothing of what is below.
double strong_at(double distance_px) {
  return distance_px <= kCore_px ? 1 : strength_at(distance_px);
}

class FacetEdgePainter {
 public:
  FacetEdgePainter(Image& image, const View& view, const Camera& camera, const ColorScheme& scheme,
                   const MeshLookup& meshes, const ContrastLines* contrast)
      : image_(image),
        view_(view),
        projector_(view, camera),
        scheme_(scheme),
        meshes_(meshes),
        contrast_(contrast) {}

  void draw() {
    for (const uint32_t id : seen_ids()) draw_edges_of(id);
    for (std::size_t pixel = 0; pixel < strength_.size(); ++pixel) {
      if (strength_[pixel] > 0) blend(pixel);
    }
  }

 private:
  /// Returns the ids of the primitives with meshes that the picture shows, each once.
  std::vector<uint32_t> seen_ids() {
    std::vector<uint32_t> ids;
    uint32_t last = csgcore::kNoPrimitive;
    for (const uint32_t id : image_.id) {
      if (id != last && meshes_.primitive_of(id)) ids.push_back(id);
      last = id;
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    if (!ids.empty()) strength_.assign(image_.rgb.size(), 0);
    return ids;
  }

  void draw_edges_of(uint32_t id) {
    const Primitive& primitive = *meshes_.primitive_of(id);
    if (primitive.mesh()) {
      draw_triangles(id, *primitive.mesh(), primitive.local_to_world);
      return;
    }
    const FacetMesh& facets = meshes_.facets_of(primitive);
    map_vertices(facets.mesh.vertices, primitive.local_to_world);
    for (const FacetMesh::Edge& edge : facets.edges) {
      draw_edge(id, world_[edge.from], world_[edge.to]);
    }
  }

  void draw_triangles(uint32_t id, const csgcore::TriangleMesh& mesh, const csgcore::Affine& map) {
    map_vertices(mesh.vertices(), map);
    for (const csgcore::TriangleMesh::Triangle& triangle : mesh.triangles()) {
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
        // A closed mesh has every edge in both directions.
        if (mesh.is_closed() && from > to) continue;
        draw_edge(id, world_[from], world_[to]);
      }
    }
  }

  void map_vertices(std::span<const Vec3> vertices, const csgcore::Affine& local_to_world) {
    world_.clear();
    for (const Vec3& vertex : vertices) world_.push_back(local_to_world.point(vertex));
  }

  void draw_edge(uint32_t id, const Vec3& from, const Vec3& to) {
    const auto ends = projector_.line(from, to);
    if (!ends) return;
    const auto& [a, b] = *ends;
    const bool along_x = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
    const double width = image_.width_px, height = image_.height_px;
    const double first = along_x ? std::min(a.x, b.x) : std::min(a.y, b.y);
    const double last = along_x ? std::max(a.x, b.x) : std::max(a.y, b.y);
    const double slope = last == first ? 0
                         : along_x     ? (b.y - a.y) / (b.x - a.x)
                                       : (b.x - a.x) / (b.y - a.y);
    // Across the line a pixel away counts 1 / (1 + |slope|) along x and y together.
    const double reach = kFade_px * (1 + std::abs(slope));
    const double steps = along_x ? width : height;
    const double across = along_x ? height : width;
    // Ends are rounded outwards by half a pixel, so that short edges are not lost.
    for (double step = std::max(0.0, std::floor(first)); step <= std::min(last, steps - 1);
         ++step) {
      const double at = std::clamp(step + 0.5, first, last);
      const double middle = along_x ? a.y + slope * (at - a.x) : a.x + slope * (at - a.y);
      const double end = std::min(middle + reach, across);
      for (double i = std::max(0.0, std::ceil(middle - reach - 0.5)); i + 0.5 < end; ++i) {
        const auto column = static_cast<std::size_t>(along_x ? step : i);
        const auto row = static_cast<std::size_t>(along_x ? i : step);
        mark(row * image_.width_px + column, id, from, to,
             std::abs(i + 0.5 - middle) / (1 + std::abs(slope)));
      }
    }
  }

  /// Marks the pixel if it shows a face beside the edge: then the edge lies in the face's plane.
  void mark(std::size_t pixel, uint32_t id, const Vec3& from, const Vec3& to, double distance_px) {
    if (image_.id[pixel] != id) return;
    const Vec3 normal(image_.normal[pixel]);
    const Vec3 position(image_.position[pixel]);
    const double tolerance =
        kInFace * (glm::distance(from, view_.eye) + glm::distance(to, view_.eye));
    if (std::abs(glm::dot(normal, from - position)) > tolerance ||
        std::abs(glm::dot(normal, to - position)) > tolerance) {
      return;
    }
    const double strength = contrast_ ? strong_at(distance_px) : strength_at(distance_px);
    strength_[pixel] = std::max(strength_[pixel], static_cast<float>(strength));
  }

  /// Returns the unlit colour of the face that a pixel shows.
  std::array<double, 3> face_color(std::size_t pixel) {
    const Primitive& primitive = *meshes_.primitive_of(image_.id[pixel]);
    const Rgb& scheme = is_cut_face(primitive, pixel) ? scheme_.back : scheme_.front;
    std::array<double, 3> color = {scheme.r / 255.0, scheme.g / 255.0, scheme.b / 255.0};
    std::optional<csgcore::Color> of_face = primitive.color;
    if (!of_face && primitive.mesh() && !primitive.mesh()->colors().empty()) {
      const csgcore::CanonicalPrimitive& canonical = canonical_of(primitive);
      of_face = primitive.mesh()->color_at(canonical.world_to_canonical *
                                           (Vec3(image_.position[pixel]) - canonical.center));
    }
    if (of_face) {
      const std::array<float, 3> own = {of_face->r, of_face->g, of_face->b};
      for (std::size_t i = 0; i < 3; ++i) {
        if (own[i] >= 0) color[i] = std::min(1.0f, own[i]);
      }
    }
    return color;
  }
  /// A face is seen from within the primitive where the primitive has been taken away.
  bool is_cut_face(const Primitive& primitive, std::size_t pixel) {
    if (primitive.cut_faces != csgcore::CutFaces::kByTree) {
      return primitive.cut_faces == csgcore::CutFaces::kAlways;
    }
    const Vec3 normal(image_.normal[pixel]), position(image_.position[pixel]);
    if (primitive.mesh()) {
      const double step = kInFace * glm::distance(position, view_.eye);
      return csgcore::contains(canonical_of(primitive), position + step * normal);
    }
    const Vec3 center = primitive.local_to_world.point(primitive.polyhedron()->canonical().center);
    return glm::dot(normal, position - center) < 0;
  }

  /// Returns OpenSCAD's colour of a line: half way from the face's to white.
  std::array<double, 3> pale_color(std::size_t pixel) {
    std::array<double, 3> line = face_color(pixel);
    for (double& value : line) value = 255 * (value + 1) / 2;
    return line;
  }

  /// Mixes the pixel's colour with the line's.
  void blend(std::size_t pixel) {
    std::array<double, 3> line;
    if (contrast_) {
      std::ranges::copy(contrast_->at(pixel), line.begin());
    } else {
      line = pale_color(pixel);
    }
    const double share = strength_[pixel];
    for (std::size_t i = 0; i < 3; ++i) {
      uint8_t& value = image_.rgb[pixel][i];
      value = static_cast<uint8_t>(std::lround(value + share * (line[i] - value)));
    }
  }

  const csgcore::CanonicalPrimitive& canonical_of(const Primitive& primitive) {
    const auto [entry, is_new] = canonical_.try_emplace(primitive.id);
    if (is_new) entry->second = csgcore::canonicalize(primitive);
    return entry->second;
  }

  Image& image_;
  const View& view_;
  Projector projector_;
  const ColorScheme& scheme_;
  const MeshLookup& meshes_;
  const ContrastLines* const contrast_;
  std::vector<float> strength_;  // by pixel; none if no mesh is seen
  std::vector<Vec3> world_;      // the vertices of the mesh at hand
  std::unordered_map<uint32_t, csgcore::CanonicalPrimitive> canonical_;  // of meshes, by id
};

}  // namespace

void draw_facet_edges(Image& image, const View& view, const Camera& camera,
                      const ColorScheme& scheme, const MeshLookup& meshes,
                      const ContrastLines* contrast) {
  FacetEdgePainter(image, view, camera, scheme, meshes, contrast).draw();
}

}  // namespace frontend
