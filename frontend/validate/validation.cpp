#include "validation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>

#include "csgcore/boundary_mesh.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/subdivision.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "faceted_scene.hpp"
#include "nef_judge.hpp"
#include "planted_error.hpp"
#include "ray_judge.hpp"
#include "samples.hpp"
#include "solids/triangles_of.hpp"
#include "volume.hpp"

namespace validation {
namespace {

using csgcore::Scene;
using csgcore::Vec3;
using csgcore::View;

constexpr const char* kSmooth = "as drawn, against rays in exact arithmetic";
constexpr const char* kFaceted = "in facets, against CGAL Nef polyhedra";
constexpr const char* kMeshed = "the mesh in facets, against CGAL Nef polyhedra";
constexpr const char* kSagitta = "as drawn, against CGAL within the facets' sagitta";

/// Shares of the time limit at which the smooth scene's comparison, CGAL's building and the
/// comparison of what is drawn with that have to be done. The rest is for the mesh.
constexpr double kSmoothUntil = 0.3, kBuiltUntil = 0.8, kFacetsUntil = 0.95;

/// Rays for the volume per ray of a comparison: a ray adds little to the estimate, and costs
/// little.
constexpr uint64_t kVolumeRays = 10;

/// The least time that CGAL takes for a primitive. Measured: 7 ms (cubes that do not touch) to 30
/// ms (spheres of 8 fragments that do). A scene that would take too long even at a fraction of that
/// is not begun.
constexpr double kLeastNefTime_s = 2e-3;

/// A scene prepared for the CPU.
class Model {
 public:
  explicit Model(const Scene& scene)
      : solid_(csgcore::canonical_primitives(scene), scene.model), subdivision_(solid_, {}) {}

  const csgcore::Solid& solid() const { return solid_; }
  const csgcore::Subdivision& subdivision() const { return subdivision_; }

  /// Returns whether the solid contains the point, by the cell that contains it.
  bool contains(const Vec3& point) const {
    const csgcore::Leaf* leaf = subdivision_.find(point);
    if (!leaf) return false;
    if (leaf->test_count == 0) return leaf->solid;
    return csgcore::evaluate(subdivision_.tests_of(*leaf), [&](uint32_t primitive) {
      return csgcore::contains(solid_.primitives()[primitive], point);
    });
  }

 private:
  csgcore::Solid solid_;
  csgcore::Subdivision subdivision_;
};

/// Returns the boundary of a scene's solid whose primitives are polyhedra or meshes.
csgcore::BoundaryMesh mesh_of(const Scene& scene) {
  std::vector<csgcore::TriangleSet> operands;
  for (const csgcore::Primitive& primitive : scene.primitives) {
    operands.push_back(frontend::triangles_of(primitive));
  }
  return csgcore::boundary_mesh(operands, scene.model);
}

double area_of(const csgcore::TriangleSet& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += glm::length(
        glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
  }
  return sum / 2;
}

double volume_of(const csgcore::TriangleSet& mesh, const Vec3& middle) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += glm::dot(mesh.vertices[a] - middle,
                    glm::cross(mesh.vertices[b] - middle, mesh.vertices[c] - middle));
  }
  return sum / 6;
}

/// The pictures of a scene by one renderer.
struct Pictures {
  std::vector<View> views;
  std::vector<csgcore::Hits> hits;  // by view
};

Pictures pictures_by_cpu(const Model& model, const std::vector<View>& views) {
  Pictures pictures{views, {}};
  for (const View& view : views) {
    csgcore::TraceStats stats;
    csgcore::trace(model.solid(), view, {}, pictures.hits.emplace_back(), stats);
  }
  return pictures;
}

/// Returns nothing if, by the settings or for lack of a GPU, the CPU draws.
std::optional<Pictures> pictures_by_gl(const Scene& scene, const std::vector<View>& views,
                                       frontend::RendererKind renderer) {
  if (renderer == frontend::RendererKind::kCpu) return std::nullopt;
  frontend::RenderSettings settings;
  settings.renderer = renderer;
  settings.measured_channels = true;
  Pictures pictures{views, {}};
  for (const View& view : views) {
    frontend::RenderStats stats;
    const csgcore::Image image = frontend::render(scene, view, settings, stats);
    if (!stats.renderer.starts_with("gl")) return std::nullopt;
    pictures.hits.push_back(hits_of(image, scene));
  }
  return pictures;
}

class Validation {
 public:
  Validation(const Scene& scene, const Settings& settings, const Progress& progress)
      : settings_(settings),
        progress_(progress),
        scene_(scene),
        drawn_(with_error(scene_)),
        smooth_(drawn_),
        box_(csgcore::Solid(csgcore::canonical_primitives(scene_), scene_.model).bounds()) {
    for (uint64_t i = 0; i < settings.views && !box_.empty(); ++i) {
      views_.push_back(random_view(box_, settings.seed, i));
    }
  }

  Result run() {
    if (box_.empty()) {
      result_.notes.push_back("the design is empty: there is nothing to compare");
      return std::move(result_);
    }
    compare_smooth();
    if (const std::unique_ptr<const NefTruth> truth = build_nef()) {
      const Model facets(with_error(facets_));
      compare_facets(*truth, facets);
      compare_mesh(*truth);
      compare_within_sagitta(*truth);
    }
    return std::move(result_);
  }

 private:
  Scene with_error(const Scene& scene) const {
    return settings_.planted_error.empty() ? scene
                                           : with_planted_error(scene, settings_.planted_error);
  }

  Clock::time_point after(double share) const {
    return start_ + std::chrono::duration_cast<Clock::duration>(
                        std::chrono::duration<double>(share * settings_.time_limit_s));
  }

  /// Returns the deadline of the next check: those that are left share the time equally.
  static Clock::time_point next_deadline(Clock::time_point end, int checks_left) {
    const Clock::time_point now = Clock::now();
    return now + (std::max(end, now) - now) / checks_left;
  }

  /// The report names primitives by their place in the file.
  void add(CheckResult check) {
    for (Json& disagreement : check.disagreements) {
      for (const char* what : kWithPrimitive) {
        if (!disagreement.contains(what) || !disagreement[what].contains("primitive")) continue;
        Json& primitive = disagreement[what]["primitive"];
        primitive = scene_.primitives[primitive.get<uint32_t>()].id;
      }
    }
    result_.checks.push_back(std::move(check));
  }

  void compare_rays(const char* group, const Model& model, const MakeRayJudge& make_judge,
                    Clock::time_point deadline) {
    add(run_check(group, "rays", settings_.rays, deadline, progress_, [&]() -> Judge {
      return [&, judge = std::shared_ptr<RayJudge>(make_judge())](uint64_t i) {
        const View view = random_ray_view(box_, settings_.seed, i);
        const SeenRay ray{csgcore::pixel_ray(view, 0, 0), view.projection,
                          traced_ray(model.subdivision(), view)};
        Verdict verdict = judge->judge(ray);
        if (verdict.outcome == Outcome::kDisagreed) {
          verdict.details["ray"] = json_of(ray.ray, ray.projection);
        }
        return verdict;
      };
    }));
  }

  /// The first samples are pixels of all views, so that every view is judged even if time is short.
  void compare_pictures(const char* group, const char* name, const Pictures& pictures,
                        const MakeRayJudge& make_judge, Clock::time_point deadline) {
    if (pictures.views.empty()) return;
    const std::vector<uint32_t> pixels = scattered_pixels(pictures.views[0]);
    const uint64_t views = pictures.views.size();
    add(run_check(group, name, pixels.size() * views, deadline, progress_, [&]() -> Judge {
      return [&, judge = std::shared_ptr<RayJudge>(make_judge())](uint64_t i) {
        const uint64_t v = i % views;
        const View& view = pictures.views[v];
        const uint32_t pixel = pixels[i / views];
        const uint32_t x = pixel % view.width_px, y = pixel / view.width_px;
        const SeenRay ray{csgcore::pixel_ray(view, x, y), view.projection,
                          seen_at(pictures.hits[v], pixel)};
        Verdict verdict = judge->judge(ray);
        if (verdict.outcome == Outcome::kDisagreed) {
          verdict.details["view"] = v;
          verdict.details["pixel"] = {x, y};
          verdict.details["ray"] = json_of(ray.ray, ray.projection);
        }
        return verdict;
      };
    }));
  }

  void compare_smooth() {
    const oracle::ExactScene exact(scene_);
    const auto judge_by = [&](const Tolerance& tolerance) -> MakeRayJudge {
      return [&] { return make_exact_judge(exact, tolerance); };
    };
    const Clock::time_point end = after(kSmoothUntil);
    compare_rays(kSmooth, smooth_, judge_by(kDoubleTolerance), next_deadline(end, 3));
    compare_pictures(kSmooth, "pictures", pictures_by_cpu(smooth_, views_),
                     judge_by(kDoubleTolerance), next_deadline(end, 2));
    compare_gl_pictures(kSmooth, drawn_, judge_by(kFloatTolerance), next_deadline(end, 1));
  }

  void compare_gl_pictures(const char* group, const Scene& drawn, const MakeRayJudge& make_judge,
                           Clock::time_point deadline) {
    if (const auto pictures = pictures_by_gl(drawn, views_, settings_.renderer)) {
      compare_pictures(group, "pictures by OpenGL", *pictures, make_judge, deadline);
    }
  }

  /// Returns null, and adds a note, if CGAL does not finish.
  std::unique_ptr<const NefTruth> build_nef() {
    const Clock::time_point deadline = after(kBuiltUntil);
    const double least_s = kLeastNefTime_s * static_cast<double>(scene_.primitives.size());
    const double left_s = std::chrono::duration<double>(deadline - Clock::now()).count();
    if (left_s <= least_s) return too_large();
    std::optional<Scene> facets = faceted(scene_, settings_.fragments);
    if (!facets) return no_polyhedra();
    facets_ = *std::move(facets);
    const Clock::time_point start = Clock::now();
    const auto keep_waiting = [this, deadline] {
      const auto left = std::chrono::ceil<std::chrono::seconds>(deadline - Clock::now());
      progress_("CGAL, at most " + std::to_string(left.count()) + " s more", -1);
      return true;
    };
    auto truth = std::make_unique<const NefTruth>(facets_, box_.diagonal(),
                                                  csgcore::thickness_tolerance(box_),
                                                  oracle::NefLimits{deadline, keep_waiting});
    if (truth->status() == oracle::NefStatus::kBuilt) {
      result_.cgal_s = std::chrono::duration<double>(Clock::now() - start).count();
      return truth;
    }
    if (truth->status() == oracle::NefStatus::kDeadline) return too_large();
    result_.notes.push_back("CGAL failed (" + truth->reason() +
                            "): compared with rays in exact arithmetic only");
    return nullptr;
  }

  std::unique_ptr<const NefTruth> no_polyhedra() {
    result_.notes.push_back(
        "not all primitives have facets that make convex polyhedra or closed meshes: compared with "
        "rays in exact arithmetic only");
    return nullptr;
  }

  std::unique_ptr<const NefTruth> too_large() {
    char limit[32];
    std::snprintf(limit, sizeof limit, "%g", settings_.time_limit_s);
    result_.notes.push_back("too large for CGAL Nef polyhedra within --time-limit=" +
                            std::string(limit) + " s: compared with rays in exact arithmetic only");
    return nullptr;
  }

  void compare_facets(const NefTruth& truth, const Model& facets) {
    const PointSampler points(box_, truth.solid().mesh(), settings_.seed);
    const auto judge_by = [&](const Tolerance& tolerance) -> MakeRayJudge {
      return [&] { return make_nef_judge(truth, tolerance); };
    };
    const Clock::time_point end = after(kFacetsUntil);
    compare_volume(truth, facets, next_deadline(end, 8));
    compare_points(kFaceted, truth, facets, "points", next_deadline(end, 7),
                   [&](uint64_t i) { return points.in_box(i); });
    compare_points(kFaceted, truth, facets, "points near surfaces", next_deadline(end, 6),
                   [&](uint64_t i) { return points.near_surface(i); });
    compare_points(kFaceted, truth, facets, "points near edges", next_deadline(end, 5),
                   [&](uint64_t i) { return points.near_edge(i); });
    compare_rays(kFaceted, facets, judge_by(kDoubleTolerance), next_deadline(end, 4));
    compare_pictures(kFaceted, "pictures", pictures_by_cpu(facets, views_),
                     judge_by(kDoubleTolerance), next_deadline(end, 3));
    compare_gl_pictures(kFaceted, with_error(facets_), judge_by(kFloatTolerance),
                        next_deadline(end, 2));
  }

  template <typename PointOf>
  void compare_points(const char* group, const NefTruth& truth, const Model& facets,
                      const char* name, Clock::time_point deadline, const PointOf& point_of) {
    add(run_check(group, name, settings_.points, deadline, progress_, [&]() -> Judge {
      return [&](uint64_t i) {
        const Vec3 point = point_of(i);
        Verdict verdict = judge_point(truth, point, facets.contains(point));
        if (verdict.outcome == Outcome::kDisagreed) verdict.details["point"] = json_of(point);
        return verdict;
      };
    }));
  }

  /// The boundary's mesh is a judge that knows nothing of rays.
  void compare_mesh(const NefTruth& truth) {
    progress_("the mesh", -1);
    const csgcore::BoundaryMesh mesh = mesh_of(with_error(facets_));
    const double exact = truth.solid().volume().get_d();
    const double volume = volume_of(mesh, (box_.min + box_.max) / 2.0);
    Verdict verdict;
    verdict.error = std::abs(volume - exact) / (exact > 0 ? exact : 1);
    // Each face may be displaced by rounding, along its normal.
    const double bound = truth.displacement() * area_of(mesh);
    if (std::abs(volume - exact) > bound || csgcore::open_edges(mesh) > 0) {
      verdict.outcome = Outcome::kDisagreed;
      verdict.details = {{"differs_in", "volume"},
                         {"seen", volume},
                         {"open_edges", csgcore::open_edges(mesh)},
                         {"expected", exact}};
    }
    add_single(kMeshed, "volume", std::move(verdict));
    if (mesh.triangles.empty()) return;
    Scene scene;
    scene.primitives.push_back(csgcore::make_mesh(
        std::make_shared<const csgcore::TriangleMesh>(mesh.vertices, mesh.triangles)));
    csgcore::CsgTreeBuilder builder;
    builder.primitive(0);
    scene.model = builder.finish();
    const Model model(scene);
    const PointSampler points(box_, truth.solid().mesh(), settings_.seed);
    compare_points(kMeshed, truth, model, "points", next_deadline(after(1), 3),
                   [&](uint64_t i) { return points.in_box(i); });
    compare_points(kMeshed, truth, model, "points near surfaces", next_deadline(after(1), 2),
                   [&](uint64_t i) { return points.near_surface(i); });
    compare_points(kMeshed, truth, model, "points near edges", next_deadline(after(1), 1),
                   [&](uint64_t i) { return points.near_edge(i); });
  }

  void add_single(const char* group, const char* name, Verdict verdict) {
    CheckResult check;
    check.group = group;
    check.name = name;
    check.planned = 1;
    check.add(std::move(verdict));
    add(std::move(check));
  }

  void compare_volume(const NefTruth& truth, const Model& facets, Clock::time_point deadline) {
    const VolumeEstimate estimate = estimate_volume(
        facets.subdivision(), settings_.seed, kVolumeRays * settings_.rays, deadline, progress_);
    const double exact = truth.solid().volume().get_d();
    const double error = std::abs(estimate.volume - exact);
    Verdict verdict;
    verdict.error = exact > 0 ? error / exact : error;
    if (error > estimate.bound) {
      verdict.outcome = Outcome::kDisagreed;
      verdict.details = {{"differs_in", "volume"},
                         {"seen", estimate.volume},
                         {"bound", estimate.bound},
                         {"expected", exact}};
    }
    add_single(kFaceted, "volume", std::move(verdict));
    char note[200];
    std::snprintf(note, sizeof note, "volume in facets: %.9g by CGAL, %.9g ± %.2g by %llu rays",
                  exact, estimate.volume, estimate.bound,
                  static_cast<unsigned long long>(estimate.rays));
    result_.notes.emplace_back(note);
  }

  void compare_within_sagitta(const NefTruth& truth) {
    const PointSampler points(box_, truth.solid().mesh(), settings_.seed);
    std::vector<SagittaShell> shells;
    for (const csgcore::Primitive& primitive : scene_.primitives) {
      shells.emplace_back(primitive, settings_.fragments);
    }
    constexpr uint64_t kKinds = 3;
    add(run_check(kSagitta, "points", kKinds * settings_.points, after(1), progress_,
                  [&]() -> Judge {
                    return [&](uint64_t i) {
                      const Vec3 point = i % kKinds == 0   ? points.in_box(i / kKinds)
                                         : i % kKinds == 1 ? points.near_surface(i / kKinds)
                                                           : points.near_edge(i / kKinds);
                      return judge_smooth_point(truth, shells, point);
                    };
                  }));
  }

  /// A point between a smooth surface and its facets is undecided; the error is its depth below the
  /// smooth surface.
  Verdict judge_smooth_point(const NefTruth& truth, const std::vector<SagittaShell>& shells,
                             const Vec3& point) const {
    Verdict verdict = judge_point(truth, point, smooth_.contains(point));
    if (verdict.outcome != Outcome::kDisagreed) return verdict;
    double depth = std::numeric_limits<double>::infinity();
    for (const SagittaShell& shell : shells) {
      if (shell.contains(point)) depth = std::min(depth, shell.depth(point));
    }
    if (depth < std::numeric_limits<double>::infinity()) {
      return {Outcome::kUndecided, depth / truth.size(), {}};
    }
    verdict.details["point"] = json_of(point);
    return verdict;
  }

  const Settings& settings_;
  const Progress& progress_;
  const Clock::time_point start_ = Clock::now();
  const Scene& scene_;
  const Scene drawn_;
  Scene facets_;
  const Model smooth_;
  const csgcore::Box box_;
  std::vector<View> views_;
  Result result_;
};

}  // namespace

bool Result::agrees() const {
  return std::all_of(checks.begin(), checks.end(),
                     [](const CheckResult& check) { return check.disagreed == 0; });
}

Result validate(const Scene& scene, const Settings& settings, const Progress& progress) {
  return Validation(scene, settings, progress).run();
}

}  // namespace validation
