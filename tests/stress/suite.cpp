#include "suite.hpp"

#include <algorithm>

#include "support/full_run.hpp"

namespace stress {
namespace {

/// Returns the tallies of one case: by method, over its cameras.
std::vector<Line> run_case(const Family& family, const Case& one,
                           const std::vector<Method>& methods, const Tolerance& tolerance) {
  const Scene scene = one.make();
  const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
  std::vector<Line> lines;
  std::vector<Drawer> drawers;
  for (const Method& method : methods) {
    lines.push_back({family.name + "/" + one.name, method.name, {}});
    drawers.push_back(method.prepare(scene, solid));
  }
  for (const Camera& camera : one.cameras(scene, picture_size())) {
    Oracle oracle(scene, camera.view);
    for (size_t i = 0; i < methods.size(); ++i) {
      Tally tally = judge(oracle, drawers[i](camera.view), tolerance);
      if (!tally.first_wrong.empty()) tally.first_wrong = camera.name + ": " + tally.first_wrong;
      for (std::string& pixel : tally.undecided_pixels) pixel = camera.name + ": " + pixel;
      lines[i].tally.add(tally);
    }
  }
  return lines;
}

}  // namespace

PictureSize picture_size() {
  return test_support::full_run() ? PictureSize{640, 480} : PictureSize{96, 72};
}

std::vector<const Case*> cases_to_run(const Family& family) {
  std::vector<const Case*> result;
  for (const Case& one : family.cases) {
    if (!one.only_full_run || test_support::full_run()) result.push_back(&one);
  }
  return result;
}

std::vector<Line> totals(const std::vector<Line>& lines, const std::string& name) {
  std::vector<Line> result;
  for (const Line& line : lines) {
    Line* total = nullptr;
    for (Line& known : result) {
      if (known.method == line.method) total = &known;
    }
    if (!total) total = &result.emplace_back(Line{name, line.method, {}});
    total->tally.add(line.tally);
  }
  return result;
}

void print_header() {
  std::printf("%-44s %-8s %9s %6s %6s %6s %6s %6s %6s %8s %8s %8s %8s\n", "case", "method", "hits",
              "hit", "prim", "pos", "norm", "undec", "speck", "pos max", "pos med", "nrm max",
              "nrm med");
}

void print_line(const Line& line) {
  const Tally& t = line.tally;
  const auto number = [](uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf("%-44s %-8s %9llu %6llu %6llu %6llu %6llu %6llu %6llu %8.1e %8.1e %8.1e %8.1e\n",
              line.name.c_str(), line.method.c_str(), number(t.hits), number(t.wrong[1]),
              number(t.wrong[2]), number(t.wrong[3]), number(t.wrong[4]), number(t.undecided),
              number(t.speckle), t.position_errors.largest(), t.position_errors.median(),
              t.normal_errors.largest(), t.normal_errors.median());
  std::fflush(stdout);
}

namespace {

/// Prints the first wrong pixel of the line, and its undecided ones.
void print_pixels(const Tally& tally) {
  if (!tally.first_wrong.empty()) std::printf("    wrong %s\n", tally.first_wrong.c_str());
  constexpr size_t kMostPrinted = 8;
  const std::vector<std::string>& undecided = tally.undecided_pixels;
  for (size_t i = 0; i < std::min(kMostPrinted, undecided.size()); ++i) {
    std::printf("    undecided %s\n", undecided[i].c_str());
  }
}

}  // namespace

std::vector<Line> run_family(const Family& family, const std::vector<Method>& methods,
                             const Tolerance& tolerance) {
  std::printf("%s of %ux%u pixels\n", test_support::full_run() ? "full run" : "sample",
              picture_size().width_px, picture_size().height_px);
  print_header();
  std::vector<Line> lines;
  for (const Case* one : cases_to_run(family)) {
    for (Line& line : run_case(family, *one, methods, tolerance)) {
      print_line(line);
      print_pixels(line.tally);
      lines.push_back(std::move(line));
    }
  }
  for (const Line& total : totals(lines, family.name + ", all")) print_line(total);
  return lines;
}

}  // namespace stress
