// A design held against the oracles: scadray's renderers and core against CGAL.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "check.hpp"
#include "csgcore/scene.hpp"
#include "frontend/render.hpp"

namespace validation {

struct Settings {
  int fragments = 8;        // of the facets that CGAL is given; ≥ 3
  uint64_t points = 10000;  // of each kind
  uint64_t rays = 10000;
  uint64_t views = 3;
  uint64_t seed = 1;
  double time_limit_s = 40;
  /// kAuto: OpenGL is compared, too, where there is a GPU.
  frontend::RendererKind renderer = frontend::RendererKind::kAuto;
  std::string planted_error;  // see planted_error.hpp; empty: none
};

struct Result {
  std::vector<CheckResult> checks;
  std::vector<std::string> notes;  // what was not compared, and why; figures
  double cgal_s = 0;               // that CGAL took for its solid; 0: it was not asked, or gave up
  bool agrees() const;
};

/// Compares
/// - the smooth scene, as it is drawn, with rays in exact arithmetic;
/// - the scene in facets with CGAL's Nef polyhedra: points, rays, pictures and the volume;
/// - the smooth scene with CGAL's solid, where the facets' sagitta tells nothing else.
/// The last two are left out, with a note, if CGAL does not get done in time. What is compared
/// takes as long as the limit allows, but a first part of every check is compared in any case. The
/// same settings give the same result, but for the extent that the time allows.
Result validate(const csgcore::Scene& scene, const Settings& settings, const Progress& progress);

}  // namespace validation
