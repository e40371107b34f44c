#include "extrusion_judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "csgcore/solid.hpp"
#include "csgcore/subdivision.hpp"
#include "frontend/importer.hpp"
#include "openscad_facets.hpp"
#include "ray_judge.hpp"
#include "render/scene_scale.hpp"
#include "samples.hpp"
#include "subtree_text.hpp"
#include "subtrees/node_row.hpp"

namespace validation {
namespace {

using csgcore::Ray;
using csgcore::Vec3;
using frontend::Node;
using frontend::NodeKind;
using frontend::NodeTree;

constexpr const char* kGroup = "extrusions that turn, against OpenSCAD's facets";

/// OpenSCAD writes six digits of a coordinate: each is off by half a unit of the last one.
constexpr double kDigits = 1e-5;
/// OpenSCAD cuts the coordinates of outlines to 2^-16, and drops what is within 1.4 times that.
constexpr double kGrid = 0x1p-14;

bool has_argument(const NodeTree& tree, const Node& node, language::ArgumentName name) {
  frontend::NodeProblems told;  // when the design was imported
  return !frontend::NodeReader(tree, node, told).find(name).is_undef();
}

/// Returns whether OpenSCAD 2021.01 knows all that the subtree says.
bool is_known(const NodeTree& tree, uint32_t root) {
  for (uint32_t i = root; i < tree.nodes[root].end; ++i) {
    const Node& node = tree.nodes[i];
    const bool is_new =
        node.kind == NodeKind::kRoof || node.kind == NodeKind::kFill ||
        (node.kind == NodeKind::kLinearExtrude &&
         (has_argument(tree, node, "v") || has_argument(tree, node, "segments"))) ||
        (node.kind == NodeKind::kRotateExtrude && has_argument(tree, node, "start"));
    if (is_new) return false;
  }
  return true;
}

/// What a linear_extrude node says.
frontend::LinearExtrudeArguments arguments_of(const NodeTree& tree, const Node& node) {
  frontend::NodeProblems told;  // when the design was imported
  frontend::NodeReader reader(tree, node, told);
  frontend::DesignFonts fonts({});  // which it has none of
  return std::get<frontend::LinearExtrudeNode>(read_node(reader, {{}, fonts})).arguments;
}

bool turns(const NodeTree& tree, const Node& node) {
  if (node.kind != NodeKind::kLinearExtrude) return false;
  const frontend::LinearExtrudeArguments given = arguments_of(tree, node);
  return given.height > 0 && (given.twist != 0 || given.top_scale.x != given.top_scale.y);
}

/// The nodes that turn, but for those that are not of the model.
std::vector<uint32_t> turning_nodes(const NodeTree& tree) {
  std::vector<uint32_t> result;
  for (uint32_t i = 0; i < tree.size();) {
    const Node& node = tree.nodes[i];
    if ((node.modifiers & language::kBackgroundModifier) != 0) {
      i = node.end;
      continue;
    }
    if (turns(tree, node)) result.push_back(i);
    ++i;
  }
  return result;
}

/// Triangles, of which a ray sees the nearest.
class Facets {
 public:
  Facets(const frontend::FaceSet& faces, double scale) {
    for (std::size_t i = 0; i < faces.face_count(); ++i) {
      const std::span<const uint32_t> ring = faces.face(i);
      for (std::size_t k = 2; k < ring.size(); ++k) {
        triangles_.push_back({scale * faces.points[ring[0]], scale * faces.points[ring[k - 1]],
                              scale * faces.points[ring[k]]});
        for (const Vec3& corner : triangles_.back()) box_.merge(corner);
      }
    }
  }

  const csgcore::Box& box() const { return box_; }

  Seen first_seen(const Ray& ray) const {
    Seen seen;
    for (const auto& [a, b, c] : triangles_) {
      const Vec3 ab = b - a, ac = c - a, across = glm::cross(ray.direction, ac);
      const double volume = glm::dot(ab, across);
      if (volume == 0) continue;
      const Vec3 from = ray.origin - a;
      const double u = glm::dot(from, across) / volume;
      const Vec3 turned = glm::cross(from, ab);
      const double v = glm::dot(ray.direction, turned) / volume;
      if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
      const double s = glm::dot(ac, turned) / volume;
      if (s >= seen.s) continue;
      seen = {0, s, ray.origin + s * ray.direction, glm::normalize(glm::cross(ab, ac))};
    }
    return seen;
  }

 private:
  std::vector<std::array<Vec3, 3>> triangles_;
  csgcore::Box box_;
};

/// One node, as scadray and as openscad has it.
class Extrusion {
 public:
  Extrusion(const csgcore::Scene& scene, const Facets& facets, double rounding, std::string place)
      : solid_(csgcore::canonical_primitives(scene), scene.model),
        subdivision_(solid_, {}),
        facets_(facets),
        box_(facets.box()),
        tolerance_(rounding),
        place_(std::move(place)) {
    box_.merge(solid_.bounds());
    const Vec3 largest = glm::max(glm::abs(box_.min), glm::abs(box_.max));
    tolerance_ += kDigits * std::max({largest.x, largest.y, largest.z});
  }

  Verdict judge(uint64_t seed, uint64_t index) const {
    const csgcore::View view = random_ray_view(box_, seed, kLines * index);
    const Ray ray = csgcore::pixel_ray(view, 0, 0);
    const Seen seen = traced_ray(subdivision_, view);
    const Seen expected = facets_.first_seen(ray);
    Verdict verdict;
    if (seen.hit() && expected.hit()) {
      verdict.error = distance(ray, seen, expected) / box_.diagonal();
    }
    if (is_same(ray, seen, expected)) return verdict;
    // Rounding may have moved an edge past the ray.
    constexpr int kDirections = 8;
    for (int i = 0; i < kDirections; ++i) {
      const Ray other = moved(ray, 2 * std::numbers::pi * i / kDirections, 2 * tolerance_, 0);
      if (!is_same(ray, seen, facets_.first_seen(other))) continue;
      verdict.outcome = Outcome::kUndecided;
      return verdict;
    }
    verdict.outcome = Outcome::kDisagreed;
    verdict.details = {{"differs_in", seen.hit() == expected.hit() ? "position" : "hit or miss"},
                       {"node", place_},
                       {"ray", json_of(ray, view.projection)}};
    for (const auto& [who, what] : {std::pair{"seen", seen}, std::pair{"expected", expected}}) {
      verdict.details[who] = {{"hit", what.hit()}};
      if (what.hit()) verdict.details[who]["position"] = json_of(what.position);
    }
    return verdict;
  }

 private:
  /// Every second of the random rays is a line; others start within the box.
  static constexpr uint64_t kLines = 2;

  /// Measured along the normal, so that it does not depend on the ray's angle.
  static double distance(const Ray& ray, const Seen& a, const Seen& b) {
    const double facing = std::min(std::abs(glm::dot(a.normal, ray.direction)),
                                   std::abs(glm::dot(b.normal, ray.direction)));
    return std::abs(a.s - b.s) * facing;
  }

  bool is_same(const Ray& ray, const Seen& a, const Seen& b) const {
    if (!a.hit() || !b.hit()) return a.hit() == b.hit();
    return distance(ray, a, b) <= tolerance_;
  }

  csgcore::Solid solid_;
  csgcore::Subdivision subdivision_;
  Facets facets_;
  csgcore::Box box_;
  double tolerance_;
  std::string place_;
};

class ExtrusionJudge {
 public:
  ExtrusionJudge(const frontend::DesignTree& tree, const frontend::ImportOptions& options,
                 Clock::time_point deadline)
      : design_(tree), tree_(*tree.nodes), options_(options), deadline_(deadline) {
    options_.facets = frontend::Facets::kAll;
    // The snapshots cut long edges that turn, which the facets of the release do not have.
    options_.language = language::LanguageVersion::k2021;
    if (options.font_files) fonts_ = options.font_files();
  }

  void take(uint32_t node) {
    const std::string text = subtree_text(tree_, node, options_, fonts_);
    if (!known_.insert(text).second) return;
    if (!is_known(tree_, node)) return leave_out("OpenSCAD 2021.01 does not know all of them");
    const OpenScadFacets truth = facets_by_openscad(text, deadline_);
    if (!truth.faces) {
      const bool is_late = Clock::now() >= deadline_;
      return leave_out(is_late ? "openscad has not finished in time (raise --time-limit)"
                               : truth.problem);
    }
    const frontend::ImportedDesign design = imported(node);
    if (design.left_out > 0) return;  // which is said elsewhere
    const int exponent = frontend::scale_exponent(design.scene);
    const double scale = std::ldexp(1, exponent);
    const Facets facets(*truth.faces, scale);
    const csgcore::Scene scene =
        exponent == 0 ? design.scene : frontend::scaled(design.scene, exponent);
    if (facets.box().empty() && scene.primitives.empty()) return;
    const Vec2 top = arguments_of(tree_, tree_.nodes[node]).top_scale;
    const double rounding = kGrid * std::max({1.0, top.x, top.y}) * scale;
    const language::Place place = tree_.nodes[node].place;
    const frontend::Location location = design_.location_of(place);
    extrusions_.push_back(std::make_unique<Extrusion>(scene, facets, rounding,
                                                      design_.file_of(place) + ':' +
                                                          std::to_string(location.line) + ':' +
                                                          std::to_string(location.column)));
  }

  Result judge(const Settings& settings, const Progress& progress) {
    Result result;
    if (!extrusions_.empty()) {
      const uint64_t count = extrusions_.size();
      result.checks.push_back(
          run_check(kGroup, "rays", settings.rays * count, deadline_, progress, [&]() -> Judge {
            return
                [&](uint64_t i) { return extrusions_[i % count]->judge(settings.seed, i / count); };
          }));
    }
    if (left_out_ > 0) {
      result.notes.push_back((left_out_ == 1
                                  ? "1 extrusion that turns was"
                                  : std::to_string(left_out_) + " extrusions that turn were") +
                             " not compared with OpenSCAD's facets: " + why_);
    }
    return result;
  }

 private:
  using Vec2 = frontend::Vec2;

  /// Imports the node alone, with all digits of its numbers.
  frontend::ImportedDesign imported(uint32_t root) {
    auto alone = std::make_shared<NodeTree>(tree_.subtree(root));
    for (uint32_t i = 0; i < alone->size(); ++i) {
      alone->nodes[i].modifiers &= i == 0 ? 0 : language::kBackgroundModifier;
    }
    return frontend::import_design({alone, design_.files, design_.name}, options_);
  }

  void leave_out(const std::string& why) {
    if (left_out_++ == 0) why_ = why;
  }

  const frontend::DesignTree& design_;
  const NodeTree& tree_;
  frontend::ImportOptions options_;
  const Clock::time_point deadline_;
  std::vector<std::string> fonts_;
  std::set<std::string> known_;  // the texts of the nodes that were taken
  std::vector<std::unique_ptr<const Extrusion>> extrusions_;
  uint64_t left_out_ = 0;
  std::string why_;  // of the first that was left out
};

}  // namespace

Result judge_extrusions(const frontend::DesignTree& tree, const frontend::ImportOptions& options,
                        const Settings& settings, Clock::time_point deadline,
                        const Progress& progress) {
  const std::vector<uint32_t> nodes = turning_nodes(*tree.nodes);
  if (nodes.empty()) return {};
  ExtrusionJudge judge(tree, options, deadline);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    progress("OpenSCAD's extrusions", static_cast<double>(i) / static_cast<double>(nodes.size()));
    judge.take(nodes[i]);
  }
  return judge.judge(settings, progress);
}

}  // namespace validation
