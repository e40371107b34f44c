// Every example, drawn by OpenGL as the command draws it, against the brute-force oracle. Prints a
// table; the bar is at most 1 wrong pixel in 10,000 hits at the default settings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "csgcore/subdivision.hpp"
#include "frontend/camera.hpp"
#include "frontend/files.hpp"
#include "frontend/importer.hpp"
#include "frontend/openscad_export.hpp"
#include "frontend/parser.hpp"
#include "glrender/fixture.hpp"

namespace {

namespace fs = std::filesystem;

/// A .csg, or a .scad whose .csg is too large to be kept beside it.
frontend::ImportedDesign read_design(const fs::path& file) {
  const auto ignore_message = [](const std::string&) {};
  const frontend::FileText text =
      file.extension() == ".scad"
          ? frontend::export_with_openscad(file.string(), {}, ignore_message, [] {})
          : frontend::read_file(file.string());
  return frontend::import_design(frontend::parse(text.view(), file.filename().string()));
}

/// The command's picture without --camera, at the size.
csgcore::View default_view(const frontend::ImportedDesign& design) {
  frontend::CameraOptions options;
  options.width_px = 640;
  options.height_px = 480;
  return frontend::make_view(frontend::choose_camera(options, design.view_box), options);
}

class ExamplePictureTest : public testing::TestWithParam<fs::path> {};

TEST_P(ExamplePictureTest, EqualsTheOracle) {
  const frontend::ImportedDesign design = read_design(GetParam());
  const csgcore::View view = default_view(design);
  const csgcore::Image oracle = csgcore::reference_render(design.scene, view);
  const double size = csgcore::reference_box(design.scene).diagonal();
  const auto exact =
      gl_test::compare(gl_test::draw(design.scene, view, gl_test::leaves_of(8)), oracle, size);
  EXPECT_GT(exact.hits, 5000u);
  EXPECT_LE(exact.wrong() * 10000, exact.hits) << exact.first;
  const auto paper = gl_test::compare(
      gl_test::draw(design.scene, view, csgcore::SubdivisionOptions::paper(1, view)), oracle, size);
  std::printf(
      "%-18s %8llu hits; K = 8: %llu wrong; the paper's K = 2 at 1 px: %llu lost or wrong\n",
      GetParam().stem().c_str(), static_cast<unsigned long long>(exact.hits),
      static_cast<unsigned long long>(exact.wrong()),
      static_cast<unsigned long long>(paper.wrong()));
  // What the dropped cells lose (paper, figure 3) is little, but not nothing.
  EXPECT_LE(paper.wrong() * 20, paper.hits);
}

std::vector<fs::path> examples() {
  std::vector<fs::path> files{fs::path(SCADRAY_EXAMPLES_DIR) / "cs10000.scad"};
  for (const auto& entry : fs::directory_iterator(SCADRAY_EXAMPLES_DIR)) {
    if (entry.path().extension() == ".csg") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

INSTANTIATE_TEST_SUITE_P(, ExamplePictureTest, testing::ValuesIn(examples()),
                         [](const auto& instance) { return instance.param.stem().string(); });

}  // namespace
