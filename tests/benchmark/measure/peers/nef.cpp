// Measures CGAL's Nef polyhedra: from the .csg to the solid, without a picture.
#include <chrono>

#include "candidate.hpp"
#include "oracle/nef_solid.hpp"

namespace measure {
namespace {

using Clock = std::chrono::steady_clock;

Run build(const std::filesystem::path& csg, int fragments, double limit_s) {
  const Clock::time_point start = Clock::now();
  frontend::ImportOptions options;
  options.facets = frontend::Facets::kAll;
  const csgcore::Scene scene = read_csg(csg, options).scene;
  oracle::NefLimits limits;
  limits.deadline =
      start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit_s));
  const oracle::NefBuild built = oracle::NefSolid::build(scene, fragments, limits);
  Run run{std::chrono::duration<double, std::milli>(Clock::now() - start).count(),
          built.status == oracle::NefStatus::kDeadline,
          {},
          {}};
  if (built.status == oracle::NefStatus::kFailed) run.failure = built.reason;
  return run;
}

}  // namespace

std::vector<Candidate> nef_candidates(ExactDesign& subject) {
  std::vector<Candidate> candidates;
  for (const uint32_t fragments : fragment_counts(subject.settings())) {
    Candidate candidate{"CGAL Nef", "$fn=" + std::to_string(fragments)};
    candidate.error_by = "facets";
    candidate.fragments = fragments;
    candidate.makes_solid = true;
    candidate.run = [&subject, fragments] {
      return build(subject.faceted(fragments).csg, static_cast<int>(fragments),
                   subject.settings().peer_limit_s);
    };
    candidate.judge = [&subject, fragments] {
      PictureErrors errors;
      compare_hits(subject.faceted(fragments).hits, subject.exact(), subject.size(), errors);
      return errors;
    };
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

}  // namespace measure
