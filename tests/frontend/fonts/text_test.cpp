// Tests text(): its letters as primitives, and what it tells. How letters stand is compared with
// OpenSCAD in openscad_text_test.
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/solid.hpp"
#include "fonts/design_fonts.hpp"
#include "fonts/text_meter.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using csgcore::Shape;
using csgcore::Vec3;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// Of Debian's package openscad-testing-data.
const std::string kFolder = "/usr/share/openscad/testdata/ttf/";
const std::string kLiberation = kFolder + "liberation-2.00.1/LiberationSans-Regular.ttf";
const std::string kSymbols = kFolder + "marvosym-3.10/marvosym.ttf";

class Text : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kLiberation)) GTEST_SKIP() << "no " << kLiberation;
  }
};

ImportedDesign import_with_fonts(const std::string& csg, ImportOptions options = {}) {
  options.font_files = [] { return std::vector<std::string>{kLiberation, kSymbols}; };
  return import_design(parse(csg, "a.csg"), options);
}

/// A text of Liberation Sans.
std::string text(const std::string& letters, const std::string& arguments = "size = 10") {
  return "text(text = \"" + letters + "\", " + arguments + ", font = \"Liberation Sans\");";
}

std::string extruded(const std::string& children) {
  return "linear_extrude(height = 2) {" + children + "}";
}

std::vector<std::string> texts_of(const std::vector<Warning>& warnings) {
  std::vector<std::string> texts;
  for (const Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

bool is_loaded(const char* library) { return dlopen(library, RTLD_NOW | RTLD_NOLOAD) != nullptr; }

/// CTest runs it in a process of its own.
TEST_F(Text, AloneLoadsTheFontLibraries) {
  constexpr const char* kLibraries[] = {"libfreetype.so.6", "libharfbuzz.so.0",
                                        "libfontconfig.so.1"};
  ImportOptions options;
  bool are_asked_for = false;
  options.font_files = [&are_asked_for] {
    are_asked_for = true;
    return std::vector<std::string>{};
  };
  import_design(parse("circle(2); cube(1);", "a.csg"), options);
  EXPECT_FALSE(are_asked_for);
  if (testing::UnitTest::GetInstance()->test_to_run_count() == 1) {
    for (const char* library : kLibraries) EXPECT_FALSE(is_loaded(library)) << library;
  }
  import_design(parse("text(\"a\");", "a.csg"), options);
  EXPECT_TRUE(are_asked_for);
  for (const char* library : kLibraries) EXPECT_TRUE(is_loaded(library)) << library;
}

TEST_F(Text, HasAPrimitiveForEachLetterWithInk) {
  const ImportedDesign design = import_with_fonts(extruded(text("no onion ")));
  EXPECT_THAT(design.warnings, IsEmpty());
  EXPECT_EQ(design.primitive_nodes, 1u);
  EXPECT_EQ(design.leaves, 1u);
  ASSERT_THAT(design.scene.primitives, SizeIs(7));
  std::set<const csgcore::Profile*> profiles;
  for (const csgcore::Primitive& letter : design.scene.primitives) {
    EXPECT_EQ(letter.shape(), Shape::kExtrusion);
    EXPECT_EQ(letter.id, 0u);
    profiles.insert(letter.profile());
  }
  EXPECT_THAT(profiles, SizeIs(3)) << "equal letters share n, o, i";
  const ImportedDesign larger = import_with_fonts(extruded(text("o", "size = 72")));
  EXPECT_TRUE(profiles.contains(larger.scene.primitives[0].profile()))
      << "of any size, and from one import to the next";
}

TEST_F(Text, KeepsTheFontsCurves) {
  const auto curves_of = [](const std::string& arguments, ImportOptions options = {}) {
    const ImportedDesign design = import_with_fonts(extruded(text("o", arguments)), options);
    size_t curves = 0, edges = 0;
    for (const csgcore::ProfileLoop& loop : design.scene.primitives.at(0).profile()->loops()) {
      for (const csgcore::ProfileEdge& edge : loop) {
        curves += edge.kind == csgcore::ProfileEdge::Kind::kBezier;
        ++edges;
      }
    }
    return std::pair(curves, edges);
  };
  const auto [curves, edges] = curves_of("size = 10");
  EXPECT_GT(curves, 8u);
  EXPECT_EQ(curves, edges);
  EXPECT_EQ(curves_of("size = 10, $fn = 100"), std::pair(curves, edges));
  EXPECT_EQ(curves_of("size = 10, $fn = 8"), std::pair(size_t{0}, 2 * edges)) << "few are meant";
  const ImportOptions faceted{.facets = Facets::kAll};
  EXPECT_EQ(curves_of("size = 10", faceted), std::pair(size_t{0}, 4 * edges)) << "30 fragments";
  EXPECT_EQ(curves_of("size = 10, $fn = 100", faceted), std::pair(size_t{0}, 13 * edges));
  EXPECT_EQ(curves_of("size = 10, $fn = 1e9", faceted), std::pair(curves, edges))
      << "too many to tell from curves";
}

TEST_F(Text, StandsAsItsArgumentsSay) {
  // OpenSCAD exports the stem from 1.28169 to 2.57689, and 9.55479 high.
  const csgcore::Box box = import_with_fonts(extruded(text("I"))).view_box;
  EXPECT_NEAR(box.min.x, 1.28169, 2e-5);
  EXPECT_NEAR(box.max.x, 2.57689, 2e-5);
  EXPECT_NEAR(box.max.y, 9.55479, 2e-5);
  EXPECT_NEAR(box.min.y, 0, 1e-9);
  EXPECT_NEAR(box.max.z, 2, 1e-9);
  const csgcore::Box small = import_with_fonts(extruded(text("I", "size = 5"))).view_box;
  EXPECT_NEAR(small.max.y, box.max.y / 2, 1e-9);
  const csgcore::Box turned = import_with_fonts(extruded(text("I", "size = -10"))).view_box;
  EXPECT_NEAR(turned.min.x, -box.max.x, 1e-9);
  EXPECT_NEAR(turned.min.y, -box.max.y, 1e-9);
  const csgcore::Box right =
      import_with_fonts(extruded(text("I", "size = 10, halign = \"right\""))).view_box;
  EXPECT_LT(right.max.x, 0);
  const csgcore::Box top =
      import_with_fonts(extruded(text("I", "size = 10, valign = \"top\""))).view_box;
  EXPECT_NEAR(top.max.y, box.max.y * (1 - 1 / 1.024), 2e-3) << "a sliver stands out";
}

TEST_F(Text, IsEmptyWithoutLettersOrSize) {
  for (const std::string& empty :
       {text(""), text("  "), text("a", "size = 0"), text("a", "size = nan"),
        text("a", "size = -inf"), std::string("text(text = 12);"), std::string("text();"),
        text("aa", "size = 10, spacing = nan")}) {
    const ImportedDesign design = import_with_fonts(extruded(empty) + "cube(1);");
    EXPECT_LE(design.scene.primitives.size(), 2u) << empty;
    EXPECT_THAT(design.warnings, IsEmpty()) << empty;
  }
  EXPECT_EQ(import_with_fonts(text("a", "size = \"x\"")).scene.primitives.size(), 1u)
      << "a size that is no number is 10";
}

TEST_F(Text, TellsOfUnknownAlignments) {
  EXPECT_THAT(
      texts_of(
          import_with_fonts(text("a", "size = 10, halign = \"middle\", valign = \"up\"")).warnings),
      ElementsAre(
          AllOf(HasSubstr("a.csg:1:1: warning: text: Unknown value for the halign parameter "
                          "(use \"left\", \"right\" or \"center\"): 'middle'")),
          HasSubstr("(use \"baseline\", \"bottom\", \"top\" or \"center\"): 'up'")));
  EXPECT_THAT(import_with_fonts(text("a", "halign = \"default\", valign = \"default\"")).warnings,
              IsEmpty())
      << "OpenSCAD's development version writes it";
}

TEST_F(Text, SaysWhichFontStandsInForAMissingOne) {
  const std::vector<Warning> warnings =
      import_with_fonts("text(\"a\", font = \"No Such Font:style=Bold\");").warnings;
  EXPECT_THAT(texts_of(warnings),
              ElementsAre(HasSubstr("a.csg:1:1: note: text: the font 'No Such Font' is not "
                                    "installed: '")));
  EXPECT_TRUE(warnings.at(0).is_note);
  for (const char* font : {"", "serif", "Sans:bold", " Liberation Sans ", "liberation sans",
                           "Liberation Sans:style=Regular", ":bold", "Nope,Liberation Sans"}) {
    EXPECT_THAT(import_with_fonts("text(\"a\", font = \"" + std::string(font) + "\");").warnings,
                IsEmpty())
        << font;
  }
}

TEST_F(Text, TakesFontsThatTheDesignBringsAlong) {
  EXPECT_THAT(import_with_fonts("text(\"a\", font = \"MarVoSym\");").warnings, IsEmpty());
  const ImportedDesign design = import_with_fonts(text("a"));
  EXPECT_THAT(design.files, ElementsAre(kLiberation, kSymbols));
  // The next import does without them.
  const ImportedDesign next = import_design(parse("text(\"a\", font = \"MarVoSym\");", "a.csg"));
  EXPECT_THAT(texts_of(next.warnings), ElementsAre(HasSubstr("'MarVoSym' is not installed")));
  EXPECT_THAT(next.files, IsEmpty());
}

TEST_F(Text, TakesFontsOfTheFolderInTheEnvironment) {
  const Environment folder("OPENSCAD_FONT_PATH", "/nowhere:" + kFolder);
  EXPECT_THAT(import_design(parse("text(\"a\", font = \"MarVoSym\");", "a.csg")).warnings,
              IsEmpty());
}

TEST_F(Text, NoticesThatAFontHasChanged) {
  const TemporaryFolder folder;
  const std::string file = folder / "font.ttf";
  ImportOptions options;
  options.font_files = [&] { return std::vector<std::string>{file}; };
  const auto notes = [&] {
    return import_design(parse("text(\"a\", font = \"MarVoSym\");", "a.csg"), options)
        .warnings.size();
  };
  EXPECT_EQ(notes(), 1u) << "it is missing";
  std::filesystem::copy_file(kSymbols, file);
  EXPECT_EQ(notes(), 0u);
  std::filesystem::remove(file);
  std::filesystem::copy_file(kLiberation, file);
  EXPECT_EQ(notes(), 1u);
}

TEST_F(Text, IgnoresFilesThatAreNoFonts) {
  const TemporaryFolder folder;
  const std::string picture =
      folder.write("picture.ttf", std::string("\x89PNG\r\n\x1a\n") + std::string(5000, '\x07'));
  ImportOptions options;
  options.font_files = [&] {
    return std::vector<std::string>{picture, folder.path(), folder / "missing.ttf", kSymbols};
  };
  const ImportedDesign design =
      import_design(parse("text(\"a\", font = \"MarVoSym\");", "a.csg"), options);
  EXPECT_THAT(design.warnings, IsEmpty());
  EXPECT_THAT(design.scene.primitives, SizeIs(1));
}

TEST_F(Text, TakesAnyBytes) {
  // Each byte that is no UTF-8 is a letter that stands for it.
  EXPECT_THAT(import_with_fonts(extruded(text("a\xff\xe4"
                                              "b\xed\xa0\x80")))
                  .scene.primitives,
              SizeIs(7));
  EXPECT_THAT(import_with_fonts(extruded(text("a",
                                              "script = \"\x80\", language = \"\xff\", "
                                              "direction = \"\xf0\", size = 3")))
                  .scene.primitives,
              SizeIs(1));
  const std::string many(20000, 'x');
  EXPECT_THAT(import_with_fonts(extruded(text(many))).scene.primitives, SizeIs(many.size()));
}

TEST_F(Text, HasTheBoxOfAllItsLettersWhereItIsTurned) {
  // OpenSCAD turns the corners of the text's own box.
  const std::string turn = "multmatrix([[0.6,-0.8,0,0],[0.8,0.6,0,0],[0,0,1,0],[0,0,0,1]]) {";
  for (const std::string& letters : {text("IoI"), extruded(text("IoI"))}) {
    const csgcore::Box box = import_with_fonts(letters).view_box;
    const csgcore::Box turned = import_with_fonts(turn + letters + "}").view_box;
    EXPECT_NEAR(turned.min.x, 0.6 * box.min.x - 0.8 * box.max.y, 1e-9);
    EXPECT_NEAR(turned.max.x, 0.6 * box.max.x - 0.8 * box.min.y, 1e-9);
    EXPECT_NEAR(turned.min.y, 0.8 * box.min.x + 0.6 * box.min.y, 1e-9);
    EXPECT_NEAR(turned.max.y, 0.8 * box.max.x + 0.6 * box.max.y, 1e-9);
  }
}

TEST_F(Text, TakesItsTimeInProportion) {
  // HarfBuzz alone would take seconds for either.
  std::string accents = "e";
  for (int i = 0; i < 20000; ++i) accents += "\u0301";
  EXPECT_THAT(import_with_fonts(extruded(text(accents))).warnings, IsEmpty());
  std::string languages;
  for (int i = 0; i < 5000; ++i) {
    languages += "text(\"a\", language = \"x" + std::to_string(i) + "\");\n";
  }
  EXPECT_THAT(import_with_fonts(languages).scene.primitives, SizeIs(5000));
}

TEST_F(Text, IsInPartsWhatIsInOne) {
  // Longer than what is shaped at once, and from the right to the left.
  std::string words;
  for (int i = 0; i < 1000; ++i) words += "abcde fghi ";
  for (const char* direction : {"ltr", "rtl"}) {
    const auto primitives_of = [&](const std::string& letters) {
      return import_with_fonts(extruded(text(letters, "size = 10, direction = \"" +
                                                          std::string(direction) + "\"")))
          .scene.primitives;
    };
    const auto few = primitives_of("abcde fghi "), many = primitives_of(words);
    ASSERT_THAT(few, SizeIs(9));
    ASSERT_THAT(many, SizeIs(9000));
    const double step = many[9].local_to_world.translation.x - many[0].local_to_world.translation.x;
    for (size_t i = 0; i < many.size(); ++i) {
      ASSERT_EQ(many[i].profile(), few[i % 9].profile()) << i;
      ASSERT_NEAR(many[i].local_to_world.translation.x,
                  few[i % 9].local_to_world.translation.x + step * static_cast<double>(i / 9), 1e-6)
          << i;
    }
  }
}

TEST_F(Text, IsAPlaneFigureLikeOthers) {
  const std::string one = text("I");
  for (const std::string& csg :
       {extruded("hull() {" + one + "}"), extruded("offset(r = 1) {" + one + "}"),
        extruded("resize(newsize = [40, 10]) {" + one + "}"), one, "render() {" + one + "}",
        extruded("minkowski() {" + one + "circle(1); }"), "rotate_extrude() {" + one + "}",
        extruded("difference() { square(20);" + one + "}")}) {
    const ImportedDesign design = import_with_fonts(csg);
    EXPECT_THAT(design.warnings, IsEmpty()) << csg;
    EXPECT_FALSE(design.scene.model.empty()) << csg;
  }
  const ImportedDesign holes =
      import_with_fonts(extruded("difference() { square(20);" + one + "}"));
  const csgcore::Solid solid(csgcore::canonical_primitives(holes.scene), holes.scene.model);
  EXPECT_TRUE(solid.contains(Vec3(10, 5, 1)));
  EXPECT_FALSE(solid.contains(Vec3(2, 5, 1)));
}

/// The boxes that OpenSCAD 2025.07.18 gives these texts, in x and y.
TEST_F(Text, OfTheDialectOf2026StandsExactly) {
  struct Case {
    std::string arguments;
    std::array<double, 4> box;  // least and largest x, least and largest y
  };
  const std::string vertical = R"(direction = "ttb")";
  for (const auto& [arguments, box] : std::vector<Case>{
           {R"(halign = "default", valign = "default")", {1.139, 23.844, 0, 9.555}},
           {R"(halign = "center", valign = "center")", {-11.081, 11.623, -4.778, 4.777}},
           {R"(halign = "right", valign = "top")", {-23.302, -0.597, -9.555, 0}},
           {vertical, {-3.93, 4.035, -37.36, -1.737}},
           {vertical + R"(, halign = "left", valign = "center")", {0.005, 7.969, -17.809, 17.815}},
           {vertical + R"(, halign = "right", valign = "bottom")",
            {-7.97, -0.006, 1.743, 37.367}}}) {
    const ImportedDesign design = import_with_fonts(extruded(text("LTE", arguments)),
                                                    {.language = language::LanguageVersion::k2026});
    EXPECT_NEAR(design.view_box.min.x, box[0], 2e-3) << arguments;
    EXPECT_NEAR(design.view_box.max.x, box[1], 2e-3) << arguments;
    EXPECT_NEAR(design.view_box.min.y, box[2], 2e-3) << arguments;
    EXPECT_NEAR(design.view_box.max.y, box[3], 2e-3) << arguments;
  }
}

TEST_F(Text, HasTheFeaturesThatItsFontNames) {
  const auto width = [](const std::string& features, language::LanguageVersion language) {
    const csgcore::Box box =
        import_with_fonts(
            extruded("text(text = \"AVA\", font = \"Liberation Sans" + features + "\");"),
            {.language = language})
            .view_box;
    return box.max.x - box.min.x;
  };
  EXPECT_NEAR(width("", language::LanguageVersion::k2026), 25.675, 2e-3);
  EXPECT_NEAR(width(":fontfeatures=-kern", language::LanguageVersion::k2026), 27.737, 2e-3);
  EXPECT_EQ(width(":fontfeatures=-kern", language::LanguageVersion::k2021),
            width("", language::LanguageVersion::k2021));
}

/// As OpenSCAD 2025.07.18 measures these, to the last bit: in which order it divides and adds
/// shows.
TEST_F(Text, IsMeasuredToTheLastBit) {
  struct Measured {
    const char* text;
    double size, advance, bottom, width, height, offset;
  };
  constexpr Measured kMeasured[] = {{"nbe", 7, 16.22103, -3.5728000000000004, 15.146180000000001,
                                     7.145600000000001, -3.474240000000001},
                                    {"kkohdbka", 11.1, 65.99504999999999, -5.66544,
                                     64.95842099999999, 11.33088, -5.509152000000001},
                                    {"aaaoma", 11.1, 55.712120999999996, -4.2268799999999995,
                                     55.05910799999999, 8.453759999999999, -4.0705919999999995}};
  const auto meter = make_text_meter();
  const std::string fonts[] = {kLiberation};
  for (const Measured& wanted : kMeasured) {
    language::TextRequest request;
    request.text = wanted.text;
    request.size = wanted.size;
    request.font = "Liberation Sans";
    request.valign = "center";
    const auto found = meter->measure(request, fonts);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->advance[0], wanted.advance);
    EXPECT_EQ(found->position[1], wanted.bottom);
    EXPECT_EQ(found->size[0], wanted.width);
    EXPECT_EQ(found->size[1], wanted.height);
    EXPECT_EQ(found->offset[1], wanted.offset);
  }
  language::TextRequest nothing;
  nothing.size = std::numeric_limits<double>::infinity();
  nothing.font = "Liberation Sans";
  EXPECT_TRUE(std::isnan(meter->measure(nothing, fonts)->position[0]));
}

TEST_F(Text, ScalesAboutTheOriginOfItsExtrusion) {
  const ImportedDesign design = import_with_fonts("linear_extrude(height = 2, scale = 0.5) {" +
                                                  text("I", "size = 10, halign = \"right\"") + "}");
  const csgcore::Solid solid(csgcore::canonical_primitives(design.scene), design.scene.model);
  const csgcore::Box box = design.view_box;
  const double middle = (box.min.x + 2 * box.max.x) / 2;  // the stem's at the bottom
  EXPECT_TRUE(solid.contains(Vec3(middle, 5, 0.01)));
  EXPECT_TRUE(solid.contains(Vec3(middle / 2, 2.5, 1.99)));
  EXPECT_FALSE(solid.contains(Vec3(middle, 2.5, 1.99)));
}

}  // namespace
}  // namespace frontend
