// Measures scadray itself, called as a user calls it. What its pixels see is asked of the same
// renderer in this program, whose picture must equal that of the process to the bit.
#include <cstdio>

#include "candidate.hpp"

namespace measure {
namespace {

using frontend::RendererKind;
using frontend::RenderSettings;
using frontend::Technique;

struct Drawing {
  std::string series, setting;
  RenderSettings settings;
  std::vector<std::string> arguments;
};

Drawing cpu(const char* series, uint32_t samples) {
  Drawing drawing{series, samples == 1 ? "" : std::to_string(samples) + " samples", {}, {}};
  drawing.settings.renderer = RendererKind::kCpu;
  drawing.settings.samples = samples;
  drawing.arguments = {"--renderer=cpu", "--samples=" + std::to_string(samples)};
  return drawing;
}

Drawing gl_cells(uint32_t leaf_primitives, double threshold_px) {
  char threshold[32];
  std::snprintf(threshold, sizeof threshold, "%g", threshold_px);
  const std::string k = std::to_string(leaf_primitives);
  Drawing drawing{"scadray GL cells, K = " + k,
                  threshold_px > 0 ? threshold + std::string(" px") : "all cells",
                  {},
                  {"--renderer=gl", "--technique=cells", "--leaf-primitives=" + k,
                   std::string("--threshold=") + threshold}};
  drawing.settings.renderer = RendererKind::kGl;
  drawing.settings.technique = Technique::kCells;
  drawing.settings.leaf_primitives = leaf_primitives;
  drawing.settings.threshold_px = threshold_px;
  return drawing;
}

Drawing gl_tiles() {
  Drawing drawing{"scadray GL tiles", "", {}, {"--renderer=gl", "--technique=tiles"}};
  drawing.settings.renderer = RendererKind::kGl;
  drawing.settings.technique = Technique::kTiles;
  return drawing;
}

std::vector<Drawing> drawings(bool quick) {
  std::vector<Drawing> all{cpu("scadray CPU", 1)};
  for (const uint32_t samples : {4u, 16u, 64u}) {
    all.push_back(cpu("scadray CPU, antialiased", samples));
  }
  const std::vector<double> thresholds_px =
      quick ? std::vector<double>{1} : std::vector<double>{4, 2, 1, 0.5, 0.25};
  for (const uint32_t leaf_primitives : {2u, 8u}) {
    for (const double px : thresholds_px) all.push_back(gl_cells(leaf_primitives, px));
  }
  all.push_back(gl_cells(8, 0));
  return all;
}

std::vector<std::string> command(const ExactDesign& subject, const std::filesystem::path& csg,
                                 const std::filesystem::path& picture,
                                 const std::vector<std::string>& arguments) {
  std::vector<std::string> words{subject.settings().scadray, "-q", "-o", picture,
                                 "--threads=" + std::to_string(subject.settings().threads)};
  words.insert(words.end(), subject.camera_arguments().begin(), subject.camera_arguments().end());
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.push_back(csg);
  return words;
}

void require_same(const Picture& process, const Picture& here, const std::string& what) {
  if (process.rgb != here.rgb) {
    throw WrongAnswer(what + ": the command's picture is not the library's");
  }
}

PictureErrors judge(const ExactDesign& subject, const Drawing& drawing,
                    const std::filesystem::path& file) {
  RenderSettings settings = drawing.settings;
  settings.measured_channels = true;
  settings.threads = subject.settings().threads;
  const csgcore::Image image = draw(subject.scene(), subject.view(), settings);
  csgcore::Hits hits = csgcore::hits_of(image, subject.scene());
  if (settings.renderer == RendererKind::kCpu) hits = subject.traced();  // an image's are floats
  const Picture picture = read_picture(file);
  require_same(picture, picture_of(image), subject.design() + ", " + drawing.series);
  PictureErrors errors;
  compare_hits(hits, subject.exact(), subject.size(), errors);
  const ExactPictures& exact = subject.pictures();
  compare_colours(picture, exact.plain, exact.antialiased, errors);
  if (settings.samples > 1) errors.colour_wrong.reset();  // its edges are meant to be mixed
  return errors;
}

/// Returns whether OpenGL draws by tiles, as it reports.
bool has_gl_tiles(const ExactDesign& subject) {
  frontend::RenderStats stats;
  try {
    frontend::render(subject.scene(), subject.view(), gl_tiles().settings, stats);
  } catch (const frontend::Error&) {  // no OpenGL: its other drawings will report that
    return false;
  }
  return stats.technique == "tiles";
}

Candidate of(ExactDesign& subject, const Drawing& drawing) {
  const std::filesystem::path picture = subject.file(".scadray.png");
  Candidate candidate{drawing.series, drawing.setting, true, true};
  candidate.run = [&subject, drawing, picture] {
    return run_of(run_process(command(subject, subject.csg(), picture, drawing.arguments),
                              {subject.settings().peer_limit_s}));
  };
  candidate.judge = [&subject, drawing, picture] { return judge(subject, drawing, picture); };
  return candidate;
}

/// Draws OpenSCAD's facets by scadray.
Candidate faceted(ExactDesign& subject, uint32_t fragments) {
  const std::filesystem::path picture = subject.file(".scadray.png");
  Candidate candidate{"scadray --facets=all", "$fn=" + std::to_string(fragments), true};
  candidate.error_by = "facets";
  candidate.fragments = fragments;
  candidate.run = [&subject, fragments, picture] {
    return run_of(run_process(command(subject, subject.faceted(fragments).csg, picture,
                                      {"--renderer=cpu", "--facets=all"}),
                              {subject.settings().peer_limit_s}));
  };
  candidate.judge = [&subject, fragments, picture] {
    const FacetedDesign& design = subject.faceted(fragments);
    const Picture drawn = read_picture(picture);
    require_same(drawn, design.plain, subject.design() + ", facets");
    PictureErrors errors;
    compare_hits(design.hits, subject.exact(), subject.size(), errors);
    compare_colours(drawn, subject.pictures().plain, subject.pictures().antialiased, errors);
    return errors;
  };
  return candidate;
}

}  // namespace

std::vector<Candidate> scadray_candidates(ExactDesign& subject) {
  std::vector<Candidate> candidates;
  for (const Drawing& drawing : drawings(subject.settings().quick)) {
    candidates.push_back(of(subject, drawing));
  }
  if (has_gl_tiles(subject)) candidates.push_back(of(subject, gl_tiles()));
  for (const uint32_t fragments : fragment_counts(subject.settings())) {
    candidates.push_back(faceted(subject, fragments));
  }
  return candidates;
}

}  // namespace measure
