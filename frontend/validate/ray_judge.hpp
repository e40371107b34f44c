// A ray, what a renderer sees along it, the interface of its judges, and the judge by the exact
// ray oracle.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "check.hpp"
#include "csgcore/image.hpp"
#include "csgcore/subdivision.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"
#include "oracle/exact_rays.hpp"

namespace validation {

/// A hit or a miss, in the terms of csgcore::Hits.
struct Seen {
  uint32_t primitive = csgcore::Hits::kMiss;
  double s = std::numeric_limits<double>::infinity();
  csgcore::Vec3 position{0.0};
  csgcore::Vec3 normal{0.0};
  bool hit() const { return primitive != csgcore::Hits::kMiss; }
};

Seen seen_at(const csgcore::Hits& hits, std::size_t pixel);

struct SeenRay {
  csgcore::Ray ray;
  csgcore::Projection projection;
  Seen seen;
};

/// The errors that a renderer may make and still be right.
struct Tolerance {
  double position;    // as a share of the design's size
  double normal;      // length of the difference of the unit normals
  double coordinate;  // relative rounding of the coordinates
  /// If rays displaced sideways by this share of the design's size see something else, nothing is
  /// decided. 0: the displacement is the error of a renderer in double.
  double aside;
};

/// For the CPU: positions tell surfaces apart that are a thickness tolerance apart (NUMERICS.md
/// §1).
constexpr Tolerance kDoubleTolerance{1e-9, 1e-5, 0x1p-52, 0};
/// For OpenGL, which computes in float, and agrees except in details below 1e-4 of the scene
/// (NUMERICS.md §5). The normal may be off by half a degree.
constexpr Tolerance kFloatTolerance{1e-4, 8.7e-3, 0x1p-22, 1e-4};

/// Judges one ray after the other; each thread has its own. Errors are shares of the design's size.
class RayJudge {
 public:
  virtual ~RayJudge() = default;
  /// The details of a disagreement say what differs, what was seen and what was expected.
  virtual Verdict judge(const SeenRay& ray) = 0;
};
using MakeRayJudge = std::function<std::unique_ptr<RayJudge>()>;

Json json_of(const csgcore::Vec3& v);
Json json_of(const csgcore::Ray& ray, csgcore::Projection projection);
Json json_of(const Seen& seen);

/// Returns the ray moved sideways by `aside`, in the direction `angle` (radians) about it, and
/// forward.
csgcore::Ray moved(const csgcore::Ray& ray, double angle, double aside, double forward);

/// Returns what the only pixel of the view sees: by the CPU, through the cells of a kd-tree.
Seen traced_ray(const csgcore::Subdivision& subdivision, const csgcore::View& view);

/// Returns the judge by the exact ray oracle. The scene must outlive the judge.
std::unique_ptr<RayJudge> make_exact_judge(const oracle::ExactScene& scene,
                                           const Tolerance& tolerance);

}  // namespace validation
