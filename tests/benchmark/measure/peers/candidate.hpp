// A program with one setting, to be measured and judged.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../exact_design.hpp"
#include "../picture_errors.hpp"
#include "../process.hpp"

namespace measure {

struct Run {
  double wall_ms = 0;
  bool timed_out = false;
  std::string failure;             // why it made no picture, else empty
  std::optional<double> trace_ms;  // the time that it spends tracing, if it tells
};
/// Returns the run of a process. The failure is the last of its messages.
Run run_of(const ProcessResult& result);

struct Candidate {
  std::string series, setting;
  bool is_scadray = false;
  /// It draws the design itself: its picture is compared with what others take for an error.
  bool is_answer = false;
  const char* error_by = "pixels";
  uint32_t fragments = 0;  // $fn; 0: the design's own surfaces
  /// If it times out, designs of as many primitives, or more, are skipped as harder.
  bool makes_solid = false;
  std::function<Run()> run{};
  /// Judges what the last run has made. Throws WrongAnswer.
  std::function<PictureErrors()> judge{};
};

/// Return candidates, in each series from the quick to the slow.
std::vector<Candidate> scadray_candidates(ExactDesign& subject);
std::vector<Candidate> openscad_candidates(ExactDesign& subject, const std::string& display);
std::vector<Candidate> povray_candidates(ExactDesign& subject);
std::vector<Candidate> nef_candidates(ExactDesign& subject);

/// The least $fn of programs that make facets; there are none without an openscad to export them.
constexpr uint32_t kCoarsest = 12;
std::vector<uint32_t> fragment_counts(const Settings& settings);

}  // namespace measure
