// Compares a design's pictures and core with the oracles by CGAL.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "check.hpp"
#include "csgcore/scene.hpp"
#include "frontend/render.hpp"

namespace validation {

struct Settings {
  int fragments = 8;        // of the facets for CGAL; ≥ 3
  uint64_t points = 10000;  // of each kind
  uint64_t rays = 10000;
  uint64_t views = 3;
  uint64_t seed = 1;
  double time_limit_s = 40;
  /// kAuto: OpenGL is compared, too, if there is a GPU.
  frontend::RendererKind renderer = frontend::RendererKind::kAuto;
  std::string planted_error;  // see planted_error.hpp; empty: none
};

struct Result {
  std::vector<CheckResult> checks;
  std::vector<std::string> notes;  // what was not compared, and why; figures
  double cgal_s = 0;               // time that CGAL took for its solid; 0: it was not asked, or
                                   // gave up
  bool agrees() const;
};

/// Compares
/// - the smooth scene, as it is drawn, with rays in exact arithmetic;
/// - the scene in facets with CGAL's Nef polyhedra: points, rays, pictures and the volume;
/// - the smooth scene with CGAL's solid, up to the facets' sagitta.
///
/// The last two are left out, with a note, if CGAL does not finish in time. The comparisons fill
/// the time limit, but a first part of every check is always compared. The same settings give the
/// same result, apart from how much the time allows.
Result validate(const csgcore::Scene& scene, const Settings& settings, const Progress& progress);

/// Returns the result as a table for people. It ends with a line break. Errors are shares of the
/// design's size; that of the volume is a share of the volume.
std::string table_of(const Result& result);

/// Returns JSON with the disagreements of every check. Primitives are named by their ids
/// (csgcore/primitive.hpp), and coordinates are in the design's units times 2^`exponent`.
std::string report_of(const Result& result, const std::string& file, const Settings& settings,
                      int exponent);

}  // namespace validation
