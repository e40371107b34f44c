// Measures OpenSCAD's preview (OpenCSG) and its full render (CGAL), of the .scad.
#include "../designs.hpp"
#include "candidate.hpp"

namespace measure {
namespace {

/// The share of the pixels in which OpenSCAD's picture of its facets may differ from the exact one
/// of the same facets. If more differ, the camera or the colours are different.
constexpr double kMostDiffering = 0.02;

Candidate of(ExactDesign& subject, const std::string& display, uint32_t fragments, bool rendered) {
  const std::string setting = "$fn=" + std::to_string(fragments);
  const std::filesystem::path picture = subject.file(".openscad.png");
  Candidate candidate{rendered ? "OpenSCAD render" : "OpenSCAD preview", setting};
  candidate.error_by = "facets";
  candidate.fragments = fragments;
  candidate.makes_solid = rendered;

  std::vector<std::string> command{"openscad", "-q", "-o", picture, "-D" + setting};
  if (rendered) command.insert(command.begin() + 1, "--render");
  const std::vector<std::string>& camera = subject.camera_arguments();
  command.insert(command.end(), camera.begin(), camera.end());
  const Source source = scad_of(subject.design(), subject.settings());
  command.insert(command.end(), source.defines.begin(), source.defines.end());
  command.push_back(source.file);
  candidate.run = [command, display, picture, limit_s = subject.settings().peer_limit_s] {
    std::filesystem::remove(picture);  // openscad exits with 0 even if it has written nothing
    return run_of(
        run_process(command, {limit_s, {}, {"DISPLAY=" + display, "LIBGL_ALWAYS_SOFTWARE=1"}}));
  };
  candidate.judge = [&subject, fragments, rendered, picture] {
    const FacetedDesign& design = subject.faceted(fragments);
    const Picture drawn = read_picture(picture);
    const uint64_t other = differing_pixels(drawn, rendered ? design.rendered : design.plain);
    if (static_cast<double>(other) > kMostDiffering * static_cast<double>(drawn.rgb.size())) {
      throw WrongAnswer(
          subject.design() + ": OpenSCAD's picture differs from that of its facets, " +
          std::to_string(fragments) + " a circle, in " + std::to_string(other) + " pixels");
    }
    PictureErrors errors;
    compare_hits(design.hits, subject.exact(), subject.size(), errors);
    const ExactPictures& exact = rendered ? subject.rendered_pictures() : subject.pictures();
    compare_colours(drawn, exact.plain, exact.antialiased, errors);
    return errors;
  };
  return candidate;
}

}  // namespace

std::vector<Candidate> openscad_candidates(ExactDesign& subject, const std::string& display) {
  std::vector<Candidate> candidates;
  for (const bool rendered : {false, true}) {
    for (const uint32_t fragments : fragment_counts(subject.settings())) {
      candidates.push_back(of(subject, display, fragments, rendered));
    }
  }
  return candidates;
}

}  // namespace measure
