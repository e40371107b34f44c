// Damages files that designs import, of every format (mutator.hpp). Each is read, whatever it
// holds, or told of at its node.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "mutator.hpp"

namespace {

constexpr uint64_t kSample = 150;  // of each format

std::string content_of(const std::string& name) {
  return fuzz::content_of(std::string(SCADRAY_FUZZ_FILES) + '/' + name);
}

/// What numbers, indices and lengths may be, and what stands around them.
constexpr std::string_view kWords[] = {
    "1e300",
    "-1e160",
    "1e400",
    "1e-320",
    "1e-400",
    "nan",
    "-inf",
    "0x10",
    "-1",
    "0",
    "4294967295",
    "99999999999999999999",
    "1e46",
    "7e13",
    "-0",
    ".",
    "e",
    "-",
    " ",
    "\n",
    "\r\n",
    "\t",
    ",",
    "\"",
    "/>",
    "<g>",
    "</g>",
    "M",
    "z",
    "A1,1 0 0 1 ",
    "c",
    "rotate(1e9)",
    "stroke-width=\"1e30\" ",
    "<defs>",
    "</defs>",
    "<use href=\"#a\"/>",
    " id=\"a\"",
    " display=\"none\"",
    "50%",
    " 255 0.5 0",
    " pid=\"1\" p1=\"1\"",
    "0\nINSERT\n2\nb\n10\n0\n20\n0\n",
    "0\nENDSEC\n",
    "vertex 0 0 ",
    "outer loop\n",
    "solid",
    "endfacet\n",
    "#",
    "OFF",
    "3 0 1 2\n",
    std::string_view("\0", 1),
    "\xFF\xFF\xFF\xFF",
    "\xEF\xBB\xBF",
    "IDAT",
    "iCCP",
    "PK\x05\x06",
};

const std::string kSvg =
    "<svg width=\"40mm\" height=\"30\" viewBox=\"0 0 40 30\"><g transform=\"rotate(5 1 2) "
    "scale(2,1)\"><path d=\"M1,1 h5 v3 C9,9 8,3 4,1 A2,3 10 0 1 7,7 z m1 1 l2 2 q1 0 3 3 t1 1\"/>"
    "<rect x=\"1\" y=\"2\" width=\"9\" height=\"5\" rx=\"1\"/></g><circle cx=\"9\" cy=\"9\" "
    "r=\"3\"/>"
    "<polyline points=\"0,0 9,1 3,8 7,2\" stroke-width=\"2\" stroke-linecap=\"round\" "
    "stroke-linejoin=\"round\"/><line x1=\"1\" y1=\"2\" x2=\"9\" y2=\"3\" "
    "style=\"stroke-width:3;stroke-linejoin:bevel\"/><polygon points=\"1,1 5,1 3,4\"/></svg>";
const std::string kUses =
    "<svg width=\"50%\" viewBox=\"5 0 40 30\"><defs><rect id=\"r\" width=\"9\" height=\"5\"/><g "
    "id=\"a\"><use href=\"#r\" x=\"3\"/><use xlink:href=\"#r\" "
    "transform=\"rotate(30)\"/></g></defs><g "
    "inkscape:groupmode=\"layer\" inkscape:label=\"L\"><use id=\"u\" href=\"#a\" y=\"2\"/><path "
    "d=\"M1,1 h5 A2,3 10 0 1 7,7 z\" display=\"none\"/></g><circle id=\"c\" r=\"3\"/></svg>";
const std::string kColoredOff =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 255 0 0\n3 0 1 3 0 0.5 1.0 0.25\n3 0 3 2 7\n"
    "3 1 2 3 # none\n";
const std::string kDxf =
    "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nb\n0\nLINE\n10\n0\n20\n0\n11\n3\n21\n0\n0\nENDBLK\n0\n"
    "ENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n70\n1\n10\n0\n20\n0\n10\n9\n20\n0\n10\n5\n20\n"
    "7\n0\nARC\n10\n4\n20\n4\n40\n2\n50\n10\n51\n200\n0\nCIRCLE\n10\n20\n20\n4\n40\n3\n0\nELLIPSE\n"
    "10"
    "\n1\n20\n1\n11\n4\n21\n0\n40\n."
    "5\n41\n0\n42\n6\n0\nINSERT\n2\nb\n10\n2\n20\n2\n41\n2\n50\n30\n0\n"
    "ENDSEC\n0\nEOF\n";

class MutatedImports : public testing::Test {
 protected:
  MutatedImports() {
    std::string name = testing::TempDir() + "scadray-test-XXXXXX";
    folder_ = mkdtemp(name.data());
  }
  ~MutatedImports() override { std::filesystem::remove_all(folder_); }

  /// Damages the file that a design reads under that name.
  void run(const std::string& name, const std::string& content, const std::string& design,
           language::LanguageVersion language = language::LanguageVersion::k2021) {
    SCOPED_TRACE(name);
    fuzz::for_each_damaged(kWords, {&content, 1}, kSample, [&](const std::string& damaged) {
      std::ofstream(folder_ + '/' + name, std::ios::binary) << damaged;
      const std::clock_t start = std::clock();
      const frontend::DesignTree tree = frontend::parse(design, "fuzz.csg");
      const auto import = frontend::import_design(tree, {.language = language, .folder = folder_});
      constexpr double kMost_s = 10;  // under sanitizers; 2 without
      ASSERT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, kMost_s);
      for (const frontend::Warning& warning : import.warnings) {
        ASSERT_TRUE(warning.text.starts_with("fuzz.csg:1:")) << warning.text;
      }
    });
  }

 private:
  std::string folder_;
};

TEST_F(MutatedImports, OfSolidsAreReadOrToldOf) {
  for (const std::string name : {"step.stl", "step_text.stl", "step.off", "step.amf",
                                 "step_zipped.amf", "step.3mf", "frame.nef3"}) {
    run(name, content_of(name), "import(\"" + name + "\");");
  }
}

TEST_F(MutatedImports, Of2026AreReadOrToldOf) {
  constexpr language::LanguageVersion k2026 = language::LanguageVersion::k2026;
  for (const std::string name : {"step.off", "step.amf", "step_zipped.amf", "step.3mf"}) {
    run(name, content_of(name), "import(\"" + name + "\");", k2026);
  }
  run("a.off", kColoredOff, "import(\"a.off\");", k2026);
  run("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1/1 2/2 4/3\nf -4 4 3\nf 2 3 4\n",
      "import(\"a.obj\", center = true);", k2026);
  run("a.svg", kUses, "import(\"a.svg\");", k2026);
  run("a.svg", kUses, "import(\"a.svg\", id = \"a\", layer = \"L\", $fn = 100);", k2026);
  run("a.svg", kSvg, "linear_extrude(height = 2) { import(\"a.svg\"); }", k2026);
}

TEST_F(MutatedImports, OfHeightsAreReadOrToldOf) {
  run("h.dat", "# heights\n1 2 3\n4 5 6.5\n1e1 -2 3\n7 8 9\n", "surface(\"h.dat\");");
  for (const std::string name : {"gray8.png", "palette.png", "interlaced.png"}) {
    run(name, content_of(name), "surface(\"" + name + "\", center = true);");
  }
}

TEST_F(MutatedImports, OfDrawingsAreReadOrToldOf) {
  run("a.svg", kSvg, "linear_extrude(height = 2) { import(\"a.svg\"); }");
  run("a.dxf", kDxf, "import(\"a.dxf\");");
}

}  // namespace
