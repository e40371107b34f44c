// Tests the command line: OpenSCAD's syntax and options, scadray's own, and every error.
#include "frontend/options.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "command/export_option.hpp"
#include "command/option_row.hpp"
#include "frontend/error.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using Words = std::vector<std::string>;

/// Parses `words` after the words that every drawing needs.
Options parse_drawing(Words words) {
  words.insert(words.begin(), {"-o", "x.png", "a.csg"});
  return parse_options(words);
}

std::string error_of(const Words& words) {
  try {
    parse_options(words);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string drawing_error(Words words) {
  words.insert(words.begin(), {"-o", "x.png", "a.csg"});
  return error_of(words);
}

TEST(Options, Defaults) {
  const Options options = parse_drawing({});
  EXPECT_EQ(options.action, Action::kDraw);
  EXPECT_EQ(options.input, "a.csg");
  ASSERT_EQ(options.outputs.size(), 1u);
  EXPECT_EQ(options.outputs[0].path, "x.png");
  EXPECT_EQ(options.outputs[0].format, PictureFormat::kPng);
  EXPECT_EQ(options.camera.width_px, 512u);
  EXPECT_EQ(options.camera.height_px, 512u);
  EXPECT_FALSE(options.camera.camera);
  EXPECT_EQ(options.camera.projection, csgcore::Projection::kPerspective);
  EXPECT_STREQ(options.render.scheme.name, "Cornfield");
  EXPECT_EQ(options.render.shading, Shading::kOpenScad);
  EXPECT_EQ(options.render.show, Show::kSurface);
  EXPECT_EQ(options.render.leaf_primitives, 8u);
  EXPECT_EQ(options.render.threshold_px, 0);
  EXPECT_EQ(options.render.threads, 0u);
  EXPECT_EQ(options.render.renderer, RendererKind::kAuto);
  EXPECT_EQ(options.render.technique, Technique::kAuto);
  EXPECT_EQ(options.render.samples, 1u);
  EXPECT_FALSE(options.has_hard_warnings);
  EXPECT_FALSE(options.overlays.any());
  EXPECT_EQ(options.import.picture, PictureKind::kPreview);
  EXPECT_FALSE(options.quiet);
  EXPECT_THAT(options.warnings, IsEmpty());
  EXPECT_THAT(options.stats_path, IsEmpty());
}

TEST(Options, LanguageIsThatOfTheOptionOrTheEnvironment) {
  using language::LanguageVersion;
  unsetenv("SCADRAY_LANGUAGE");
  EXPECT_EQ(parse_drawing({}).import.language, kDefaultLanguage);
  EXPECT_EQ(parse_drawing({"--language=2026"}).import.language, LanguageVersion::k2026);
  EXPECT_EQ(parse_drawing({"--language=2021.01"}).import.language, LanguageVersion::k2021);
  EXPECT_THAT(drawing_error({"--language=2022"}), HasSubstr("--language=2022"));
  setenv("SCADRAY_LANGUAGE", "2026", 1);
  EXPECT_EQ(parse_drawing({}).import.language, LanguageVersion::k2026);
  EXPECT_EQ(parse_drawing({"--language=2021.01"}).import.language, LanguageVersion::k2021);
  setenv("SCADRAY_LANGUAGE", "old", 1);
  EXPECT_THAT(drawing_error({}), HasSubstr("SCADRAY_LANGUAGE=old"));
  setenv("SCADRAY_LANGUAGE", "", 1);
  EXPECT_EQ(parse_drawing({}).import.language, kDefaultLanguage);
  unsetenv("SCADRAY_LANGUAGE");
}

TEST(Options, EveryOutputOption) {
  const Options options = parse_options(
      {"-o", "a.png", "-ob.EXR", "--o", "c.exr", "--o=d.PNG", "-s", "e.png", "-x", "f.exr", "in"});
  std::vector<std::string> names;
  std::string formats;
  for (const Output& output : options.outputs) {
    names.push_back(output.path);
    formats += output.format == PictureFormat::kPng ? 'p' : 'e';
  }
  EXPECT_THAT(names, ElementsAre("a.png", "b.EXR", "c.exr", "d.PNG", "e.png", "f.exr"));
  EXPECT_EQ(formats, "peeppe");
}

TEST(Options, ExportFormatStandsAboveTheSuffix) {
  EXPECT_EQ(parse_options({"-o", "-", "--export-format=exr", "a"}).outputs[0].format,
            PictureFormat::kExr);
  EXPECT_EQ(parse_options({"-o", "a.exr", "--export-format", "PNG", "a"}).outputs[0].format,
            PictureFormat::kPng);
  EXPECT_THAT(error_of({"-o", "-", "a"}), HasSubstr("--export-format"));
  EXPECT_THAT(
      error_of({"-o", "x.png", "--export-format=ply", "a"}),
      HasSubstr("give png, exr, gif or webp; csg, echo or param; stl, binstl, asciistl, off"));
  EXPECT_EQ(parse_options({"-o", "x", "--export-format=NEF3", "a"}).handed.at(0).format, "nef3");
}

TEST(Options, Models) {
  const Options options =
      parse_options({"-o", "a.stl", "-o", "b.3MF", "-o", "c.png", "-o", "d.svg", "a"});
  ASSERT_EQ(options.models.size(), 3u);
  EXPECT_EQ(options.models[0].format, ModelFormat::kStl);
  EXPECT_EQ(options.models[1].format, ModelFormat::k3mf);
  EXPECT_EQ(options.models[2].format, ModelFormat::kSvg);
  EXPECT_EQ(options.outputs.size(), 1u);
  EXPECT_THAT(parse_options({"-o", "a.stl", "--stats=s", "a"}).warnings,
              testing::ElementsAre("--stats has no effect without a picture"));
  const Options text = parse_options({"-o", "a.stl", "--export-format=asciistl", "a"});
  EXPECT_EQ(text.models.at(0).format, ModelFormat::kAsciiStl);
  EXPECT_EQ(text.action, Action::kDraw);
  EXPECT_THAT(error_of({"-o", "-", "-o", "-", "--export-format=stl", "a"}),
              HasSubstr("standard output"));
  EXPECT_THAT(error_of({"-o", "x.stl", "-o", "y.off", "--animate=2049", "a"}),
              HasSubstr("more than 4096 models: 2 of -o"));
}

TEST(Options, Tolerance) {
  EXPECT_EQ(parse_options({"-o", "a.stl", "a"}).model_tolerance, 0);
  EXPECT_EQ(parse_options({"-o", "a.stl", "--tolerance=0.01", "a"}).model_tolerance, 0.01);
  for (const char* value : {"0", "-1", "x", "inf", "nan"}) {
    EXPECT_THAT(error_of({"-o", "a.stl", "--tolerance", value, "a"}), HasSubstr("above 0"));
  }
  EXPECT_THAT(parse_options({"-o", "a.png", "--tolerance=1", "a"}).warnings,
              testing::ElementsAre(HasSubstr("--tolerance has no effect")));
  EXPECT_THAT(parse_options({"--tolerance=1", "a"}).warnings, testing::IsEmpty());
}

TEST(Options, OutputsThatCannotBe) {
  for (const char* name : {"x.ply", "x", "a.png/x", ".", "x.png.gz"}) {
    EXPECT_THAT(error_of({"-o", name, "a"}), HasSubstr(".png, .exr, .gif or .webp")) << name;
  }
  EXPECT_THAT(error_of({"-o", "-", "-o", "-", "--export-format=png", "a"}),
              HasSubstr("standard output"));
  EXPECT_THAT(error_of({"-o", "-", "--stats=-", "--export-format=png", "a"}),
              HasSubstr("standard output"));
  Words many;
  for (std::size_t i = 0; i <= kMaxPictures; ++i) many.insert(many.end(), {"-o", "x.png"});
  many.push_back("a");
  EXPECT_EQ(error_of(many),
            "error: more than 4096 pictures: 4097 of -o (give -o at most 4096 times)");
  many.insert(many.begin(), "--animate=2");
  EXPECT_THAT(error_of(many), HasSubstr("for each of 2 frames (give -o at most 4096 times)"));
}

TEST(Options, TheEditorIsACommandLine) {
  EXPECT_EQ(parse_options({"a.scad"}).editor, "");
  EXPECT_EQ(parse_options({"--editor=code -g", "a.scad"}).editor, "code -g");
}

TEST(Options, WithoutAnOutputAWindowIsOpened) {
  EXPECT_EQ(parse_options({"a.csg"}).action, Action::kOpenWindow);
  EXPECT_EQ(parse_options({"-o", "x.png", "a.csg"}).action, Action::kDraw);
  EXPECT_FALSE(parse_options({"a.csg"}).has_image_size);
  EXPECT_TRUE(parse_options({"--imgsize=10,10", "a.csg"}).has_image_size);
  EXPECT_THAT(parse_options({"-d", "x.d", "--animate=3", "a.scad"}).warnings,
              testing::ElementsAre(HasSubstr("in a window, which needs no -o: -d, --animate")));
}

TEST(Options, Animation) {
  EXPECT_EQ(parse_drawing({}).frames, 0u);
  const Options options = parse_drawing({"--animate", "10"});
  EXPECT_EQ(options.frames, 10u);
  EXPECT_THAT(options.warnings, IsEmpty());
  EXPECT_EQ(parse_drawing({"--animate=0"}).frames, 0u);
  for (const char* value : {"-1", "x", "1.5", "100000"}) {
    EXPECT_THAT(drawing_error({"--animate", value}), HasSubstr("--animate=")) << value;
  }
  EXPECT_EQ(parse_options({"-o", "x.png", "-o", "y.png", "--animate=2048", "a"}).frames, 2048u);
  // The message names the limit, and what it allows.
  EXPECT_EQ(drawing_error({"--animate=4097"}),
            "error: more than 4096 pictures: 1 of -o, for each of 4097 frames (give --animate at "
            "most 4096, --animate_sharding, or fewer -o)");
  EXPECT_THAT(error_of({"-o", "x.csg", "--animate=4097", "a"}), HasSubstr("more than 4096 texts"));
  EXPECT_EQ(error_of({"-o", "x.png", "-o", "y.png", "--animate=2049", "a"}),
            "error: more than 4096 pictures: 2 of -o, for each of 2049 frames (give --animate at "
            "most 2048, --animate_sharding, or fewer -o)");
  EXPECT_THAT(error_of({"-o", "-", "--export-format=png", "--animate=2", "a"}),
              HasSubstr("standard output"));
  EXPECT_EQ(parse_options({"-o", "-", "--export-format=gif", "--animate=2", "a"}).frames, 2u);
  EXPECT_EQ(parse_options({"-o", "x.webp", "--fps=12.5", "a"}).fps, 12.5);
  EXPECT_EQ(parse_options({"-o", "x.webp", "a"}).fps, kDefaultFps);
  EXPECT_THAT(error_of({"-o", "x.gif", "--fps=51", "a"}), HasSubstr("--fps=51"));
  EXPECT_THAT(parse_drawing({"--fps=5"}).warnings,
              testing::ElementsAre(HasSubstr("--fps has no effect")));
  EXPECT_THAT(error_of({"-o", "-", "--export-format=png", "--echo", "a"}),
              HasSubstr("standard output"));
}

TEST(Options, Shards) {
  const auto frames = [](const char* shard, const char* all) {
    const Options options = parse_drawing(
        {std::string("--animate=") + all, std::string("--animate_sharding=") + shard});
    return std::pair(options.first_frame, options.end_frame);
  };
  // As OpenSCAD 2025.07 has them.
  EXPECT_EQ(frames("1/3", "4"), std::pair(0u, 1u));
  EXPECT_EQ(frames("2/3", "4"), std::pair(1u, 2u));
  EXPECT_EQ(frames("3/3", "4"), std::pair(2u, 4u));
  EXPECT_EQ(frames("1/5", "4"), std::pair(0u, 0u));
  EXPECT_EQ(frames("25/25", "99999"), std::pair(95999u, 99999u));
  EXPECT_EQ(frames("2/3", "0"), std::pair(0u, 1u));
  for (const char* value : {"3/2", "0/2", "1/0", "2", "a/b", "1/2/3", "/", "-1/2", "1/"}) {
    EXPECT_THAT(drawing_error({"--animate=4", std::string("--animate_sharding=") + value}),
                HasSubstr("give I/N, two whole numbers"))
        << value;
  }
}

TEST(Options, WhatIsTakenWithoutEffect) {
  EXPECT_THAT(parse_drawing({"--backend=CGAL", "--render=force", "--enable=all"}).warnings,
              IsEmpty());
  EXPECT_THAT(parse_drawing({"--backend=gpu"}).warnings,
              ElementsAre(HasSubstr("give manifold or cgal")));
  EXPECT_THAT(parse_drawing({"--trust-python", "--python-module=a"}).warnings,
              ElementsAre("without effect in this version: --trust-python, --python-module"));
  EXPECT_FALSE(parse_options({"a"}).resets_window);
  EXPECT_TRUE(parse_options({"--reset-window-settings", "a"}).resets_window);
}

TEST(Options, Summary) {
  EXPECT_FALSE(parse_drawing({}).summary.any());
  const Options two = parse_drawing({"--summary=area", "--summary", "bounding-box"});
  EXPECT_TRUE(two.summary.area && two.summary.bounding_box);
  EXPECT_FALSE(two.summary.camera || two.summary.cache || two.summary.time || two.summary.geometry);
  const SummaryParts all = parse_drawing({"--summary=all"}).summary;
  EXPECT_TRUE(all.area && all.bounding_box && all.camera && all.cache && all.time && all.geometry);
  EXPECT_EQ(parse_drawing({"--summary-file=s"}).summary_path, "s");
  EXPECT_THAT(drawing_error({"--summary=x"}), HasSubstr("give all, cache, time"));
  EXPECT_THAT(error_of({"-o", "-", "--export-format=stl", "--summary-file=-", "a"}),
              HasSubstr("standard output"));
  EXPECT_THAT(parse_options({"--summary=all", "a"}).warnings,
              ElementsAre(HasSubstr("in a window, which needs no -o: --summary")));
}

TEST(Options, ExportSettings) {
  const auto settings = [](const std::string& text) {
    const Options options = parse_drawing({"-O", text});
    EXPECT_THAT(options.warnings, IsEmpty()) << text;
    return options.export_settings;
  };
  EXPECT_EQ(settings("export-pdf/paper-size=a3").pdf_paper, "a3");
  EXPECT_EQ(settings("export-3mf/meta-data-title=a=b/c").three_mf_title, "a=b/c");
  EXPECT_EQ(settings("export-svg/stroke-width=2.5").svg.stroke_width, 2.5);
  EXPECT_FALSE(settings("export-svg/fill=false").svg.fill);
  EXPECT_EQ(settings("export-svg/fill-color=Blue").svg.fill_color, "Blue");
  EXPECT_EQ(settings("export-pdf/show-grid=true").pdf_paper, "a4");
  // OpenSCAD goes on, too.
  for (const char* text :
       {"export-pdf/paper-size=a9", "export-pdf/fill=perhaps", "export-svg/stroke-width=-1",
        "export-svg/stroke-width=x", "export-svg/fill-color=zzz", "export-pdf/stroke-width=1000"}) {
    EXPECT_THAT(
        parse_drawing({"-O", text}).warnings,
        ElementsAre(HasSubstr(std::string("-O ") + text + " is not understood and ignored")));
  }
  for (const char* text :
       {"export-pdf/x=1", "export-x/fill=true", "/=", "EXPORT-PDF/paper-size=a3"}) {
    EXPECT_THAT(parse_drawing({"-O", text}).warnings, ElementsAre(HasSubstr("is not known")));
  }
  for (const char* text : {"x", "", "x=1", "=", "export-pdf/paper-size", "a=b/c"}) {
    EXPECT_THAT(parse_drawing({"-O", text}).warnings, ElementsAre(HasSubstr("is no setting")));
  }
}

TEST(Options, HelpExportListsWhatOIsGiven) {
  EXPECT_EQ(parse_options({"--help-export"}).action, Action::kHelpExport);
  const std::string text = export_settings_text();
  EXPECT_THAT(text, HasSubstr("Section 'export-pdf':\n"
                              "  - paper-size (enum): [a6,a5,<a4>,a3,letter,legal,tabloid]\n"));
  EXPECT_THAT(text, HasSubstr("  - add-meta-data (bool): <true>/false\n"));
  EXPECT_THAT(text, HasSubstr("  - stroke-width (double): 0.000000 : <0.500000> : 999.000000\n"));
  EXPECT_THAT(text, HasSubstr("  - color (string): \"#f9d72c\"\n"));
}

TEST(Options, File) {
  EXPECT_EQ(parse_options({"-o", "x.png", "-"}).input, "-");
  EXPECT_EQ(parse_options({"-o", "x.png", "--", "-a.csg"}).input, "-a.csg");
  EXPECT_EQ(parse_options({"validate", "-o", "x.png"}).input, "validate");
  EXPECT_THAT(error_of({"-o", "x.png"}), HasSubstr("no file"));
  EXPECT_THAT(error_of({}), HasSubstr("no file"));
  EXPECT_THAT(error_of({"-o", "x.png", "a", "b"}), HasSubstr("more than one file"));
  // Each gets a window of its own.
  const Options windows = parse_options({"a", "--view=axes", "b", "c"});
  EXPECT_EQ(windows.input, "a");
  EXPECT_THAT(windows.further_inputs, ElementsAre("b", "c"));
  EXPECT_THAT(error_of({"--stats=s", "a", "b"}), HasSubstr("--stats is for one file"));
}

TEST(Options, WhatIsRememberedOtherwise) {
  const GivenLook none = parse_options({"a"}).given;
  EXPECT_FALSE(none.scheme || none.view || none.projection || none.shading || none.samples ||
               none.translucency);
  const GivenLook all =
      parse_options({"--colorscheme=Metallic", "--view=axes", "--projection=o", "--shading=phong",
                     "--samples=4", "--translucency=file", "a"})
          .given;
  EXPECT_TRUE(all.scheme && all.view && all.projection && all.shading && all.samples &&
              all.translucency);
}

TEST(Options, ImageSize) {
  const Options options = parse_drawing({"--imgsize=640,480"});
  EXPECT_EQ(options.camera.width_px, 640u);
  EXPECT_EQ(options.camera.height_px, 480u);
  EXPECT_EQ(parse_drawing({"--imgsize", "16384,1"}).camera.width_px, 16384u);
  EXPECT_EQ(parse_drawing({"--imgsize= 640, 480 "}).camera.height_px, 480u);
  for (const char* value : {"640", "640,480,1", "0,1", "1,0", "-1,2", "1.5,2", "a,b", ",", "1,",
                            "16385,1", "1,99999999999", "1 2,3"}) {
    EXPECT_THAT(drawing_error({"--imgsize", value}), HasSubstr("--imgsize")) << value;
  }
}

TEST(Options, CameraFlags) {
  const Options options =
      parse_drawing({"--camera=1,-2,+3.5,4e1,5,6,7", "--viewall", "--autocenter"});
  ASSERT_TRUE(options.camera.camera);
  EXPECT_EQ(options.camera.camera->target, csgcore::Vec3(1, -2, 3.5));
  EXPECT_EQ(options.camera.camera->rotation_deg, csgcore::Vec3(40, 5, 6));
  EXPECT_EQ(options.camera.camera->distance, 7);
  EXPECT_TRUE(options.camera.view_all);
  EXPECT_TRUE(options.camera.auto_center);
  for (const char* value : {"1,2,3", "1,2,3,4,5,6,7,8"}) {
    EXPECT_THAT(drawing_error({"--camera", value}), HasSubstr("--camera")) << value;
  }
}

TEST(Options, ACameraThatIsNoNumbersIsTheStandardOneAsInOpenScad) {
  for (const char* value : {"1,2,3,4,5,x", "1,2,3,4,5,", "a"}) {
    const Options options = parse_drawing({"--camera", value});
    EXPECT_THAT(options.warnings, ElementsAre(HasSubstr("--camera"))) << value;
    ASSERT_TRUE(options.camera.camera);
    EXPECT_EQ(options.camera.camera->distance, 140);
    EXPECT_FALSE(options.camera.view_all);
  }
}

TEST(Options, ACameraMayBeInfinitelyFar) {
  EXPECT_TRUE(std::isinf(parse_drawing({"--camera=1,2,3,4,5,6,inf"}).camera.camera->distance));
  EXPECT_TRUE(std::isnan(parse_drawing({"--camera=nan,2,3,4,5,6,1"}).camera.camera->target.x));
}

TEST(Options, AutoCenterAloneIsSaidToDoNothing) {
  EXPECT_THAT(parse_drawing({"--camera=1,2,3,4,5,6,7", "--autocenter"}).warnings,
              ElementsAre(HasSubstr("--autocenter")));
  EXPECT_THAT(parse_drawing({"--camera=1,2,3,4,5,6,7", "--autocenter", "--viewall"}).warnings,
              IsEmpty());
  EXPECT_THAT(parse_drawing({"--autocenter"}).warnings, IsEmpty());
}

TEST(Options, Projection) {
  for (const char* value : {"o", "ortho", "orthogonal"}) {
    EXPECT_EQ(parse_drawing({"--projection", value}).camera.projection,
              csgcore::Projection::kOrthographic);
  }
  for (const char* value : {"p", "perspective"}) {
    EXPECT_EQ(parse_drawing({"--projection", value}).camera.projection,
              csgcore::Projection::kPerspective);
  }
  EXPECT_THAT(drawing_error({"--projection=z"}), HasSubstr("--projection"));
}

TEST(Options, EveryColorScheme) {
  EXPECT_EQ(color_schemes().size(), 14u);
  for (const ColorScheme& scheme : color_schemes()) {
    EXPECT_STREQ(parse_drawing({"--colorscheme", scheme.name}).render.scheme.name, scheme.name);
  }
  EXPECT_THAT(drawing_error({"--colorscheme=cornfield"}), HasSubstr("Tomorrow Night"));
  for (const char* const name : {"Daylight Gem", "Nocturnal Gem"})
    EXPECT_NE(find_color_scheme(name), nullptr) << name;
  const Rgb back = find_color_scheme("Tomorrow Night")->back;
  EXPECT_THAT((std::vector<int>{back.r, back.g, back.b}), ElementsAre(0xde, 0x93, 0x5f));
}

TEST(Options, View) {
  EXPECT_TRUE(parse_drawing({"--view=axes"}).overlays.axes);
  const Overlays two = parse_drawing({"--view", "edges,axes"}).overlays;
  EXPECT_TRUE(two.axes && two.edges);
  EXPECT_FALSE(two.crosshairs || two.scales);
  const Options all = parse_drawing({"--render", "--view=scales,crosshairs,edges,axes"});
  EXPECT_TRUE(all.overlays.axes && all.overlays.edges && all.overlays.crosshairs &&
              all.overlays.scales);
  EXPECT_THAT(all.warnings, IsEmpty());
  EXPECT_THAT(parse_drawing({"--view=scales"}).warnings, ElementsAre(HasSubstr("without axes")));
  EXPECT_TRUE(two.edges && parse_drawing({"--view=edges"}).import.keeps_meshes);
  EXPECT_FALSE(parse_drawing({"--view=axes"}).import.keeps_meshes);
  EXPECT_TRUE(parse_drawing({"--view=grid"}).overlays.grid);
  EXPECT_FALSE(parse_drawing({"--view=axes"}).overlays.grid);
  // OpenSCAD continues, too.
  EXPECT_THAT(parse_drawing({"--view=bogus"}).warnings, ElementsAre(HasSubstr("bogus")));
}

TEST(Options, AWireframeIsTheEdgesOfTheRenderedMeshThatAreSeen) {
  const Options preview = parse_drawing({"--view=wireframe"});
  EXPECT_THAT(preview.warnings, ElementsAre(HasSubstr("--view=wireframe")));
  EXPECT_FALSE(preview.overlays.edges || preview.import.facets == Facets::kAll);
  const Options rendered = parse_drawing({"--render", "--view=wireframe"});
  EXPECT_THAT(rendered.warnings, ElementsAre(HasSubstr("edges that are seen")));
  EXPECT_TRUE(rendered.overlays.edges && rendered.import.keeps_meshes);
  EXPECT_EQ(rendered.import.facets, Facets::kAll);
  const Options window = parse_options({"--render=1", "--view=wireframe", "a.csg"});
  EXPECT_THAT(window.warnings, ElementsAre(HasSubstr("in a window")));
  EXPECT_FALSE(window.overlays.edges);
}

TEST(Options, APreviewsPictureHasNoCrosshairsButTheWindowHas) {
  const Options preview = parse_drawing({"--view=crosshairs"});
  EXPECT_FALSE(preview.overlays.crosshairs);
  EXPECT_THAT(preview.warnings, ElementsAre(HasSubstr("--view=crosshairs")));
  EXPECT_TRUE(parse_options({"--view=crosshairs", "a.csg"}).overlays.crosshairs);
}

TEST(Options, RenderAndPreview) {
  EXPECT_EQ(parse_drawing({"--render", "-q"}).import.picture, PictureKind::kRendered);
  EXPECT_EQ(parse_drawing({"--render=cgal"}).import.picture, PictureKind::kRendered);
  EXPECT_THAT(parse_drawing({"--render=1"}).warnings, IsEmpty());
  EXPECT_THAT(parse_drawing({"--preview", "-q"}).warnings, IsEmpty());
  EXPECT_THAT(parse_drawing({"--preview=cgal"}).warnings, ElementsAre(HasSubstr("cgal")));
  const Options thrown = parse_drawing({"--preview=throwntogether"});
  EXPECT_THAT(thrown.warnings, IsEmpty());
  EXPECT_EQ(thrown.import.picture, PictureKind::kThrownTogether);
  EXPECT_EQ(thrown.render.from_within, (Rgb{255, 0, 255}));
  EXPECT_EQ(parse_drawing({"--preview"}).render.from_within, std::nullopt);
  const Options both = parse_drawing({"--render", "--preview", "-q"});
  EXPECT_EQ(both.import.picture, PictureKind::kPreview);
  EXPECT_THAT(both.warnings, ElementsAre(HasSubstr("--render has no effect with --preview")));
}

TEST(Options, Panning) {
  EXPECT_FALSE(parse_options({"a.scad"}).pans_far);
  EXPECT_TRUE(parse_options({"--pan=openscad", "a.scad"}).pans_far);
  EXPECT_THAT(drawing_error({"--pan=x"}), HasSubstr("--pan"));
}

TEST(Options, ShadingAndShow) {
  EXPECT_THAT(help_text(), HasSubstr("openscad (default), phong or studio"));
  EXPECT_EQ(parse_drawing({}).render.translucency, Translucency::kFile);
  EXPECT_EQ(parse_drawing({"--translucency=depth"}).render.translucency, Translucency::kDepth);
  EXPECT_EQ(parse_options({"a.scad"}).render.translucency, Translucency::kDepth);
  EXPECT_EQ(parse_options({"--translucency=file", "a.scad"}).render.translucency,
            Translucency::kFile);
  EXPECT_EQ(parse_drawing({"--shading=phong"}).render.shading, Shading::kPhong);
  EXPECT_EQ(parse_drawing({"--shading=openscad"}).render.shading, Shading::kOpenScad);
  EXPECT_EQ(parse_drawing({"--shading=studio"}).render.shading, Shading::kStudio);
  EXPECT_THAT(drawing_error({"--shading=x"}), HasSubstr("--shading"));
  EXPECT_EQ(parse_drawing({"--show=surface"}).render.show, Show::kSurface);
  EXPECT_EQ(parse_drawing({"--show=cells"}).render.show, Show::kCells);
  EXPECT_EQ(parse_drawing({"--show=depth"}).render.show, Show::kDepth);
  EXPECT_EQ(parse_drawing({"--show=normals"}).render.show, Show::kNormals);
  EXPECT_EQ(parse_drawing({"--show=id"}).render.show, Show::kId);
  EXPECT_THAT(drawing_error({"--show=x"}), HasSubstr("--show"));
}

TEST(Options, Studio) {
  const Options given =
      parse_drawing({"--shading=studio", "--shadows=0", "--occlusion=0.5", "--edges=1"});
  EXPECT_EQ(given.render.studio.shadows, 0);
  EXPECT_EQ(given.render.studio.occlusion, 0.5);
  EXPECT_EQ(given.render.studio.edges, 1);
  EXPECT_EQ(given.render.samples, kStudioSamples);
  EXPECT_EQ(parse_options({"a.scad"}).render.shading, Shading::kStudio);
  EXPECT_EQ(parse_options({"-o", "a.png", "a.scad"}).render.shading, Shading::kOpenScad);
  EXPECT_THAT(given.warnings, IsEmpty());
  EXPECT_EQ(parse_drawing({"--shading=studio", "--samples=1"}).render.samples, 1u);
  EXPECT_THAT(drawing_error({"--shading=studio", "--edges=1.1"}),
              HasSubstr("give a number from 0 to 1"));
  EXPECT_EQ(parse_drawing({"--shading=phong"}).render.phong_shadows, 0);
  const Options phong = parse_drawing({"--shading=phong", "--shadows=0.5"});
  EXPECT_EQ(phong.render.phong_shadows, 0.5);
  EXPECT_THAT(phong.warnings, IsEmpty());
  EXPECT_THAT(parse_drawing({"--shadows=0.5"}).warnings,
              ElementsAre("--shadows has no effect without --shading=studio or phong"));
}

TEST(Options, Numbers) {
  EXPECT_EQ(parse_drawing({"--leaf-primitives=2"}).render.leaf_primitives, 2u);
  EXPECT_EQ(parse_drawing({"--threshold=1.5"}).render.threshold_px, 1.5);
  EXPECT_EQ(parse_drawing({"--threads=3"}).render.threads, 3u);
  EXPECT_EQ(parse_drawing({"--samples=1"}).render.samples, 1u);
  EXPECT_EQ(parse_drawing({"--samples=64"}).render.samples, 64u);
  EXPECT_THAT(drawing_error({"--samples=65"}), HasSubstr("1 to 64"));
  for (const char* option : {"--leaf-primitives", "--threads", "--samples"}) {
    for (const char* value : {"0", "-1", "x", "1.5", "", "99999999999"}) {
      EXPECT_THAT(drawing_error({option, value}), HasSubstr(option)) << value;
    }
  }
  for (const char* value : {"-1", "nan", "inf", "x", ""}) {
    EXPECT_THAT(drawing_error({"--threshold", value}), HasSubstr("--threshold")) << value;
  }
}

TEST(Options, Renderer) {
  EXPECT_EQ(parse_drawing({"--renderer=auto"}).render.renderer, RendererKind::kAuto);
  EXPECT_EQ(parse_drawing({"--renderer=gl"}).render.renderer, RendererKind::kGl);
  EXPECT_EQ(parse_drawing({"--renderer=cpu"}).render.renderer, RendererKind::kCpu);
  for (const char* value : {"x", "", "CPU"}) {
    EXPECT_THAT(drawing_error({"--renderer", value}), HasSubstr("give auto, gl or cpu")) << value;
  }
}

TEST(Options, Technique) {
  const auto technique_of = [](const Words& words) {
    return parse_drawing(words).render.technique;
  };
  EXPECT_EQ(technique_of({"--technique=cells"}), Technique::kCells);
  EXPECT_EQ(technique_of({"--technique=tiles"}), Technique::kTiles);
  EXPECT_THAT(drawing_error({"--technique=x"}), HasSubstr("give cells or tiles"));
  EXPECT_THAT(drawing_error({"--technique=auto"}), HasSubstr("give cells or tiles"));
  // An option about cells selects them, even with its default value.
  EXPECT_EQ(technique_of({"--leaf-primitives=8"}), Technique::kCells);
  EXPECT_EQ(technique_of({"--threshold=1"}), Technique::kCells);
  EXPECT_EQ(technique_of({"--show=cells"}), Technique::kCells);
  EXPECT_EQ(technique_of({"--threshold=0"}), Technique::kAuto);
  EXPECT_EQ(technique_of({"--show=depth"}), Technique::kAuto);
}

TEST(Options, TilesHaveNoCells) {
  EXPECT_THAT(drawing_error({"--technique=tiles", "--show=cells"}), HasSubstr("no cells to show"));
  const Options options =
      parse_drawing({"--technique=tiles", "--threshold=1", "--leaf-primitives=4"});
  EXPECT_EQ(options.render.technique, Technique::kTiles);
  EXPECT_THAT(options.warnings, ElementsAre("without effect on --technique=tiles: "
                                            "--leaf-primitives, --threshold"));
  EXPECT_THAT(parse_drawing({"--technique=cells", "--threshold=1"}).warnings, IsEmpty());
}

TEST(Options, Facets) {
  const auto import = [](const std::vector<std::string>& words) {
    const Options options = parse_drawing(words);
    EXPECT_THAT(options.warnings, IsEmpty());
    return options.import;
  };
  EXPECT_EQ(import({}).facets, Facets::kFew);
  EXPECT_EQ(import({}).few_fragments, 8);
  EXPECT_EQ(import({"--facets=all"}).facets, Facets::kAll);
  EXPECT_EQ(import({"--facets", "none"}).facets, Facets::kNone);
  EXPECT_EQ(import({"--facets=0"}).few_fragments, 0);
  EXPECT_EQ(import({"--facets=12"}).facets, Facets::kFew);
  EXPECT_EQ(import({"--facets=12"}).few_fragments, 12);
  for (const char* value : {"x", "-1", "8.5", "", "ALL", "8 "}) {
    EXPECT_THAT(drawing_error({"--facets=" + std::string(value)}), HasSubstr("--facets")) << value;
  }
}

TEST(Options, OtherFlags) {
  const Options options = parse_drawing(
      {"--skip-unsupported", "--openscad-timeout=0", "-q", "--info", "--stats=s.json"});
  EXPECT_THAT(options.warnings, IsEmpty());
  EXPECT_TRUE(options.quiet);
  EXPECT_TRUE(options.info);
  EXPECT_EQ(options.stats_path, "s.json");
  EXPECT_TRUE(parse_drawing({"--quiet"}).quiet);
}

TEST(Options, Actions) {
  for (const char* word : {"-h", "--help"}) {
    EXPECT_EQ(parse_options({word}).action, Action::kHelp);
  }
  for (const char* word : {"-v", "--version"}) {
    EXPECT_EQ(parse_options({word, "a.csg"}).action, Action::kVersion);
  }
  EXPECT_EQ(parse_options({"--info"}).action, Action::kInfo);
  for (const char* name : {"--imgsize", "--renderer", "--technique", "--samples", "-D",
                           "--skip-unsupported", "--csglimit"}) {
    EXPECT_THAT(help_text(), HasSubstr(name));
  }
}

TEST(Options, OpenScadsArgumentsAreHandedOnInOrder) {
  const Options options =
      parse_options({"-o", "x.png", "-D", "a=1", "-Db=2", "--D", "c=\"x y\"", "-p", "f.json", "-P",
                     "set", "--hardwarnings", "--check-parameters=true", "--check-parameter-ranges",
                     "false", "-m", "make", "a.SCAD"});
  EXPECT_THAT(options.openscad_arguments,
              ElementsAre("-D", "a=1", "-D", "b=2", "-D", "c=\"x y\"", "-p", "f.json", "-P", "set",
                          "--hardwarnings", "--check-parameters=true",
                          "--check-parameter-ranges=false", "-m", "make"));
  EXPECT_THAT(options.warnings, IsEmpty());
  EXPECT_TRUE(options.has_hard_warnings);
  EXPECT_THAT(parse_drawing({"-D", "a=1"}).warnings, ElementsAre(HasSubstr(".csg: -D")));
  EXPECT_THAT(parse_drawing({"--hardwarnings"}).warnings, IsEmpty());
  EXPECT_THAT(parse_options({"-o", "x.png", "-D", "a=1", "scad-x7Qf"}).warnings, IsEmpty());
  EXPECT_THAT(parse_options({"-o", "x.png", "-D", "a=1", "-"}).warnings, IsEmpty());
}

TEST(Options, WhatHasNoEffectIsSaidOnce) {
  const Options options = parse_drawing({"--csglimit=10", "--debug=all"});
  EXPECT_THAT(options.warnings, ElementsAre("without effect in this version: --csglimit, --debug"));
  EXPECT_THAT(drawing_error({"--csglimit=x"}), HasSubstr("csglimit"));
}

// Each line was tried with openscad 2021.01.
TEST(Options, SyntaxIsOpenScads) {
  // An option whose value may be missing swallows the next word.
  EXPECT_THAT(error_of({"-o", "x.png", "--render", "a.scad"}), HasSubstr("no file"));
  EXPECT_EQ(parse_options({"a.scad", "-o", "x.png", "--render"}).input, "a.scad");
  EXPECT_EQ(parse_options({"--render", "-o", "x.png", "a.scad"}).input, "a.scad");
  EXPECT_THAT(error_of({"-o", "x.png", "--preview", "a.scad"}), HasSubstr("no file"));
  // Abbreviations.
  EXPECT_EQ(parse_drawing({"--imgs", "10,20"}).camera.width_px, 10u);
  EXPECT_TRUE(parse_drawing({"--cam=0,0,0,1,1,1"}).camera.camera);
  EXPECT_EQ(parse_drawing({"--pro=o"}).camera.projection, csgcore::Projection::kOrthographic);
  EXPECT_THAT(drawing_error({"--vi=axes"}), HasSubstr("ambiguous"));
  EXPECT_TRUE(parse_drawing({"--viewa"}).camera.view_all);
  // Clusters of short options.
  EXPECT_TRUE(parse_options({"-qo", "x.png", "a"}).quiet);
  // Words that it refuses.
  EXPECT_THAT(drawing_error({"--bogus"}), HasSubstr("--bogus"));
  EXPECT_THAT(drawing_error({"-z"}), HasSubstr("-z"));
  EXPECT_THAT(drawing_error({"-camera=0,0,0,0,0,0"}), HasSubstr("-c"));
  EXPECT_THAT(drawing_error({"--Camera=0,0,0,0,0,0"}), HasSubstr("--Camera"));
  EXPECT_THAT(drawing_error({"--viewall=1"}), HasSubstr("viewall"));
  EXPECT_THAT(drawing_error({"--camera="}), HasSubstr("camera"));
  EXPECT_THAT(drawing_error({"--imgsize=1,1", "--imgsize=2,2"}), HasSubstr("more than once"));
  EXPECT_THAT(error_of({"a", "-o"}), HasSubstr("missing"));
}

TEST(Options, OurOptionsLeaveOpenScadsAbbreviationsClear) {
  EXPECT_EQ(parse_drawing({"--rend"}).import.picture, PictureKind::kRendered);
  EXPECT_EQ(parse_drawing({"--rend=cgal"}).import.picture, PictureKind::kRendered);
  EXPECT_THAT(error_of({"-o", "x.png", "--rend", "a.scad"}), HasSubstr("no file"));
  EXPECT_EQ(parse_drawing({"--renderer=cpu"}).render.renderer, RendererKind::kCpu);
}

TEST(Options, EveryWordThatTheShellsOfferIsUnderstood) {
  std::size_t words = 0;
  for (const auto rows : {openscad_options(), own_options()}) {
    for (const OptionRow& row : rows) {
      if (!row.completion.words) continue;
      const std::string option = "--" + std::string(row.names);
      for (const std::string& word : row.completion.words()) {
        const Options options = parse_options({"-o", "x.png", "a.scad", option + "=" + word});
        for (const std::string& warning : options.warnings) {
          EXPECT_THAT(warning, Not(HasSubstr("not known"))) << option << "=" << word;
        }
        ++words;
      }
    }
  }
  EXPECT_GT(words, 30u);
}

}  // namespace
}  // namespace frontend
