// Measures POV-Ray: the same primitives, camera and shading, in its language.
#include "povray/povray.hpp"

#include <cmath>
#include <fstream>
#include <regex>

#include "candidate.hpp"

namespace measure {
namespace {

/// OpenSCAD's default colours.
csgcore::ReferenceColors reference_cornfield() {
  const frontend::ColorScheme scheme = frontend::RenderSettings{}.scheme;
  const auto color = [](const frontend::Rgb& rgb) {
    return csgcore::Vec3(rgb.r, rgb.g, rgb.b) / 255.0;
  };
  return {color(scheme.background), color(scheme.front), color(scheme.back)};
}

/// Quality 3 has neither shadows nor reflections. Shades are written without gamma.
std::vector<std::string> command(const ExactDesign& subject, const std::filesystem::path& scene,
                                 const std::filesystem::path& picture) {
  const csgcore::View& view = subject.view();
  return {"povray",
          "+I" + scene.string(),
          "+O" + picture.string(),
          "+FN8",
          "-D",
          "+Q3",
          "File_Gamma=1.0",
          "+W" + std::to_string(view.width_px),
          "+H" + std::to_string(view.height_px),
          "+WT" + std::to_string(subject.settings().threads)};
}

std::optional<double> trace_ms(const std::string& output) {
  static const std::regex kLine(R"(Trace Time:[^\n]*\(([\d.]+) seconds\))");
  std::smatch match;
  if (!std::regex_search(output, match, kLine)) return std::nullopt;
  return 1000 * std::stod(match[1].str());
}

/// Returns what each pixel's centre shows, from a picture of the primitives in colours of their
/// own.
csgcore::Hits hits_of(const ExactDesign& subject) {
  const std::filesystem::path scene = subject.file(".id.pov"), picture = subject.file(".id.png");
  std::ofstream(scene) << povray::id_scene_text(subject.scene(), subject.view());
  std::vector<std::string> words = command(subject, scene, picture);
  words.push_back("-A");
  const ProcessResult result = run_process(words, {subject.settings().peer_limit_s});
  if (!result.succeeded()) throw std::runtime_error("povray: " + result.output);
  csgcore::Hits hits;
  for (const auto& pixel : read_picture(picture).rgb) {
    hits.primitive.push_back(povray::primitive_of(pixel));
  }
  return hits;
}

Candidate of(ExactDesign& subject, const std::string& series, const std::string& setting,
             const std::vector<std::string>& antialiasing) {
  const std::filesystem::path scene = subject.file(".pov"), picture = subject.file(".povray.png");
  Candidate candidate{series, setting};
  std::vector<std::string> words = command(subject, scene, picture);
  words.insert(words.end(), antialiasing.begin(), antialiasing.end());
  candidate.run = [words, limit_s = subject.settings().peer_limit_s] {
    const ProcessResult result = run_process(words, {limit_s});
    Run run = run_of(result);
    run.trace_ms = trace_ms(result.output);
    return run;
  };
  candidate.judge = [&subject, picture, is_antialiased = !setting.empty()] {
    PictureErrors errors;
    compare_hits(hits_of(subject), subject.exact(), subject.size(), errors);
    const ExactPictures& exact = subject.pictures();
    compare_colours(read_picture(picture), exact.plain, exact.antialiased, errors);
    if (is_antialiased) errors.colour_wrong.reset();  // its edges are meant to be mixed
    return errors;
  };
  return candidate;
}

}  // namespace

std::vector<Candidate> povray_candidates(ExactDesign& subject) {
  std::ofstream(subject.file(".pov"))
      << povray::openscad_scene_text(subject.scene(), subject.view(), reference_cornfield());
  const std::string antialiased = "POV-Ray, antialiased";
  std::vector<Candidate> candidates{of(subject, "POV-Ray", "", {"-A"})};
  candidates.push_back(of(subject, antialiased, "+A0.3 +R2", {"+A0.3", "+AM1", "+R2"}));
  candidates.push_back(of(subject, antialiased, "+A0.1 +R4", {"+A0.1", "+AM1", "+R4"}));
  return candidates;
}

}  // namespace measure
