// Tests what a design's picture is composed of: leaves, their cut faces, layers, boxes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "csgcore/triangle_mesh.hpp"
#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using csgcore::CutFaces;
using csgcore::Layer;
using csgcore::Vec3;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const std::string kGlass = "color([1,0,0,0.5]) { sphere(); }";
const std::string kOther = "color([0,1,0,0.5]) { cube(); }";

ImportOptions for_picture(PictureKind picture) {
  ImportOptions options;
  options.picture = picture;
  return options;
}

/// The layers of the model, with a `*` behind those that show their far side.
std::vector<std::string> model_layers(const std::string& text, PictureKind picture = {}) {
  const csgcore::Scene scene = import_text(text, for_picture(picture)).scene;
  std::vector<std::string> result;
  for (const Layer& layer : scene.layers) {
    if (layer.kind != Layer::Kind::kModel) continue;
    result.push_back(shape_of(layer.solid, scene.primitives) + (layer.shows_behind ? "*" : ""));
  }
  return result;
}

std::vector<CutFaces> cut_faces(const std::string& text, PictureKind picture = {}) {
  std::vector<CutFaces> result;
  const csgcore::Scene scene = import_text(text, for_picture(picture)).scene;
  for (const csgcore::Primitive& primitive : scene.primitives) {
    result.push_back(primitive.cut_faces);
  }
  return result;
}

TEST(Layers, AnOpaqueModelHasNone) {
  EXPECT_THAT(model_layers("color([1,0,0]) { sphere(); } difference() { cube(); sphere(); }"),
              IsEmpty());
}

TEST(Layers, OpaqueSummandsThatFollowOneAnotherAreOne) {
  EXPECT_THAT(model_layers("cube(); difference() { cube(); sphere(); }" + kGlass + "sphere();"),
              ElementsAre("(0+(1-2))", "3*", "4"));
  EXPECT_THAT(model_layers("group() { cube(); group() {" + kGlass + "} cube(); } cube();"),
              ElementsAre("0", "1*", "(2+3)"));
}

TEST(Layers, AProductOfSeveralLeavesShowsItsNearSideAlone) {
  EXPECT_THAT(model_layers("difference() {" + kGlass + "cube(); }"), ElementsAre("(0-1)"));
  EXPECT_THAT(model_layers("intersection() {" + kGlass + kOther + "}"), ElementsAre("(0*1)"));
  // The cut faces are translucent.
  EXPECT_THAT(model_layers("difference() { cube();" + kGlass + "}"), ElementsAre("(0-1)"));
}

TEST(Layers, TranslucentTreesAreMultipliedOut) {
  EXPECT_THAT(model_layers("difference() { group() {" + kGlass + kOther + "} cylinder(); }"),
              ElementsAre("(0-2)", "(1-2)"));
  EXPECT_THAT(model_layers("intersection() { group() {" + kGlass + "cube(); } group() {" + kOther +
                           "cylinder(); } }"),
              ElementsAre("(0*2)", "(0*3)", "(1*2)", "(1*3)"));
  // A - (B - C) = (A - B) + A*C, A - B*C = (A - B) + (A - C).
  EXPECT_THAT(model_layers("difference() {" + kGlass + "difference() { cube(); cylinder(); } }"),
              ElementsAre("(0-1)", "(0*2)"));
  EXPECT_THAT(model_layers("difference() {" + kGlass + "intersection() { cube(); cylinder(); } }"),
              ElementsAre("(0-1)", "(0-2)"));
}

TEST(Layers, WhatMissesTheOthersOfItsProductIsLeftOut) {
  const std::string far = "multmatrix([[1,0,0,9],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(); }";
  EXPECT_THAT(model_layers("difference() {" + kGlass + far + "}"), ElementsAre("0*"));
  EXPECT_THAT(model_layers("intersection() { group() {" + kGlass + kOther + "} group() { cube();" +
                           far + "} }"),
              ElementsAre("(0*2)", "(1*2)"));
}

TEST(Layers, EmptyOperandsAreLeftOutBeforeTreesAreMultipliedOut) {
  const auto at = [](int x) {
    return "multmatrix([[1,0,0," + std::to_string(x) +
           "],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(); }";
  };
  // An intersection of disjoint boxes; as factors of products its operands would count.
  EXPECT_THAT(model_layers("difference() {" + kGlass + "intersection() {" + at(0) + at(3) + "} }"),
              ElementsAre("0*"));
  EXPECT_THAT(model_layers("difference() {" + kGlass + "difference() {" + at(7) + at(0) + "} }"),
              ElementsAre("0*"));
}

TEST(Layers, TooManyProductsAreNotMultipliedOut) {
  std::string text = "intersection() {";
  for (int i = 0; i < 12; ++i) text += "group() {" + kGlass + kOther + "}";
  text += "}";
  EXPECT_THAT(model_layers(text), SizeIs(1));
  EXPECT_THAT(warning_of(text), HasSubstr("more than 2000 products"));
}

TEST(Layers, BackgroundPartsAreTranslucentUnlessTheyAreColored) {
  const csgcore::Scene scene =
      import_text("%sphere(); %difference() { cube(); sphere(); } %color([1,0,0]) { cube(); }")
          .scene;
  ASSERT_THAT(scene.layers, SizeIs(3));
  EXPECT_TRUE(scene.layers[0].shows_behind);
  EXPECT_FALSE(scene.layers[1].shows_behind);
  EXPECT_FALSE(scene.layers[2].shows_behind);
}

TEST(Layers, HighlightsAreTranslucentWhateverTheirColor) {
  const csgcore::Scene scene = import_text("#color([1,0,0]) { cube(); } sphere();").scene;
  ASSERT_THAT(scene.layers, SizeIs(1));
  EXPECT_EQ(scene.layers[0].kind, Layer::Kind::kHighlight);
  EXPECT_TRUE(scene.layers[0].shows_behind);
}

// A plate that cuts is thicker. Drawn so thick, a `#` plate would hide others that lie on it.
TEST(Layers, APlateThatCutsIsDrawnAsThickAsOthers) {
  const auto heights = [](const std::string& text) {
    const ImportedDesign design = import_text(text);
    const auto height = [&](const csgcore::CsgTree& tree) {
      const uint32_t last = (tree.tokens().end() - 1 - !tree.tokens().back().is_primitive)->value;
      return csgcore::canonicalize(design.scene.primitives[last]).bounds.size().z;
    };
    std::vector<double> result{height(design.scene.model)};
    for (const Layer& layer : design.scene.layers) result.push_back(height(layer.solid));
    return result;
  };
  EXPECT_THAT(heights("difference() { square(9); #circle(3); }"),
              ElementsAre(DoubleNear(1.1, 1e-12), DoubleNear(1, 1e-12)));
  EXPECT_THAT(heights("difference() { square(9); #group() { circle(3); square(2); } }"),
              ElementsAre(DoubleNear(1.1, 1e-12), DoubleNear(1, 1e-12), DoubleNear(1, 1e-12)));
  // Where it cuts what is drawn over the picture it is thick there, too.
  EXPECT_THAT(heights("#difference() { square(9); circle(3); }"),
              ElementsAre(DoubleNear(1.1, 1e-12), DoubleNear(1.1, 1e-12)));
}

TEST(Leaves, ColorsInsideOfACompoundLeafDoNotCount) {
  const csgcore::Scene scene =
      import_text("render() { color([1,0,0]) { cube(); } } color([0,0,1]) { render() { cube(); } }")
          .scene;
  EXPECT_FALSE(scene.primitives[0].color);
  EXPECT_EQ(scene.primitives[1].color->b, 1);
}

TEST(Leaves, ABackgroundPartInsideOfALeafHasItsOwnColor) {
  const csgcore::Scene scene =
      import_text("render() { group() { color([1,0,0]) { %cube(); } cube(); } }").scene;
  ASSERT_THAT(scene.primitives, SizeIs(2));
  EXPECT_EQ(scene.primitives[0].color->r, 1);
  EXPECT_FALSE(scene.primitives[1].color);
}

TEST(Leaves, CutFacesFollowTheSignOfTheLeaf) {
  EXPECT_THAT(cut_faces("render() { difference() { cube(); sphere(); } }"),
              ElementsAre(CutFaces::kNever, CutFaces::kNever));
  EXPECT_THAT(cut_faces("difference() { cube(); render() { difference() { cube(); sphere(); } } }"),
              ElementsAre(CutFaces::kByTree, CutFaces::kAlways, CutFaces::kAlways));
  // A - (B - C) takes C's part from A.
  EXPECT_THAT(
      cut_faces("difference() { cube(); difference() { cube();"
                "render() { intersection() { cube(); sphere(); } } } }"),
      ElementsAre(CutFaces::kByTree, CutFaces::kByTree, CutFaces::kNever, CutFaces::kNever));
}

TEST(Leaves, OfOnePrimitiveOrOfNothingAreNothingSpecial) {
  EXPECT_THAT(cut_faces("difference() { cube(); render() { sphere(); } }"),
              ElementsAre(CutFaces::kByTree, CutFaces::kByTree));
  EXPECT_EQ(
      model_of("difference() { cube(); render() { } render() { difference() { cube(r = 0); } } }"),
      "(0-1)");
  EXPECT_EQ(model_of("intersection() { cube(); render() { group() { } } }"), "-");
}

TEST(Leaves, ACompoundLeafIsOneProduct) {
  const std::string leaf =
      "color([1,0,0,0.5]) { render() { cube(); difference() { sphere(); cube(); } } }";
  EXPECT_THAT(model_layers(leaf), ElementsAre("(0+(1-2))*"));
  EXPECT_THAT(model_layers("difference() {" + leaf + "sphere(); }"), ElementsAre("((0+(1-2))-3)"));
}

TEST(Leaves, NestedRendersAreOneLeaf) {
  EXPECT_THAT(cut_faces("render() { difference() { cube(); render() { cube(); sphere(); } } }"),
              ElementsAre(CutFaces::kNever, CutFaces::kNever, CutFaces::kNever));
}

TEST(Leaves, TheFinalRenderHasNone) {
  EXPECT_THAT(cut_faces("render() { difference() { cube(); sphere(); } }", PictureKind::kRendered),
              ElementsAre(CutFaces::kByTree, CutFaces::kByTree));
}

// OpenSCAD resizes the solid that the operations have made, with the marks of its cut faces.
TEST(Leaves, TheFinalRenderKeepsTheCutFacesOfWhatIsResized) {
  const std::string hollow =
      "resize(newsize = [50, 50, 15], auto = [0,0,0]) { difference() { cube(10, center = true);"
      "cylinder(h = 20, r1 = 1, r2 = 1, center = true); } }";
  const ImportOptions rendered = for_picture(PictureKind::kRendered);
  EXPECT_EQ(trees_of(hollow, rendered), "(0-0) | - | -");
  EXPECT_EQ(trees_of("difference() { cube(100, center = true);" + hollow + "}", rendered),
            "(0-(1-1)) | - | -");
  for (const csgcore::Primitive& primitive : import_text(hollow, rendered).scene.primitives) {
    EXPECT_EQ(primitive.cut_faces, CutFaces::kByTree);
  }
  for (const csgcore::Primitive& primitive : import_text(hollow).scene.primitives) {
    EXPECT_EQ(primitive.cut_faces, CutFaces::kNever);
  }
}

TEST(Leaves, AHighlightedLeafIsTakenOnce) {
  EXPECT_EQ(trees_of("difference() { sphere(); #render() { cube(); sphere(); } }"),
            "(0-1-2) | - | (1+2)");
}

TEST(Leaves, AreCounted) {
  const ImportedDesign design = import_text(
      "cube(); render() { cube(); sphere(); } %render() { cube(); sphere(); } #cube();");
  EXPECT_EQ(design.leaves, 4u);
  EXPECT_EQ(design.compound_leaves, 2u);
}

TEST(LeafBoxes, AreThoseOfWhatTheOperationsLeave) {
  const std::string cut =
      "render() { difference() { cube(size = 10);"
      "multmatrix([[1,0,0,4],[0,1,0,-1],[0,0,1,-1],[0,0,0,1]]) { cube(size = 20); } } }";
  expect_box(import_text(cut).view_box, Vec3(0), Vec3(4, 10, 10), 1e-4);
  ImportOptions unmeasured;
  unmeasured.measures_leaves = false;
  expect_box(import_text(cut, unmeasured).view_box, Vec3(0), Vec3(10), 1e-4);
  // In the frame of the leaf: its corners are turned.
  expect_box(
      import_text("multmatrix([[0,-1,0,0],[1,0,0,0],[0,0,1,5],[0,0,0,1]]) {" + cut + "}").view_box,
      Vec3(-10, 0, 5), Vec3(0, 4, 15), 1e-4);
  // A subtracted leaf does not count, and neither does what it would leave.
  expect_box(import_text("difference() { cube(size = 3);" + cut + "}").view_box, Vec3(0), Vec3(3),
             0);
}

TEST(LeafBoxes, TheFinalRenderHasTheBoxOfTheResult) {
  const std::string text =
      "difference() { cube(size = 10);"
      "multmatrix([[1,0,0,4],[0,1,0,-1],[0,0,1,-1],[0,0,0,1]]) { cube(size = 20); } }";
  expect_box(import_text(text).view_box, Vec3(0), Vec3(10), 0);
  expect_box(import_text(text, for_picture(PictureKind::kRendered)).view_box, Vec3(0),
             Vec3(4, 10, 10), 1e-4);
}

/// A cube with a thin pin through it, which is cut at both ends so that nothing tells how far it
/// reaches.
const std::string kPinned =
    "render() { difference() { group() { cube(size = 10, center = true);"
    "cylinder(r1 = 0.7, r2 = 0.7, h = 100, $fn = 8, center = true); }"
    "multmatrix([[1,0,0,-5],[0,1,0,-5],[0,0,1,45]]) { cube(10); }"
    "multmatrix([[1,0,0,-5],[0,1,0,-5],[0,0,1,-55]]) { cube(10); } } }";
const std::string kPlateAtPin =
    "multmatrix([[1,0,0,-5],[0,1,0,-5],[0,0,1,30]]) { cube([10, 10, 2]); }";

// The boxes of leaves decide about products: none may miss a part of its leaf.
TEST(LeafBoxes, HoldThinPartsWhateverTheyDecide) {
  expect_box(import_text(kPinned).view_box, Vec3(-5, -5, -45), Vec3(5, 5, 45), 1e-9);
  EXPECT_THAT(model_layers("color([1,0,0,0.5]) { difference() {" + kPlateAtPin + kPinned + "} }"),
              ElementsAre("(0-((1+2)-3-4))"));
  EXPECT_THAT(model_layers("color([1,0,0,0.5]) { intersection() {" + kPlateAtPin + kPinned + "} }"),
              ElementsAre("(0*((1+2)-3-4))"));
  const csgcore::Scene together = import_text("difference() {" + kPlateAtPin + kPinned + "}",
                                              for_picture(PictureKind::kThrownTogether))
                                      .scene;
  EXPECT_EQ(shape_of(together.model, together.primitives), "(0+((1+2)-3-4))");
}

// OpenSCAD's facets are within the ball, which is what is drawn and cut.
TEST(LeafBoxes, HoldWhatIsRoundWhateverTheyDecide) {
  EXPECT_THAT(model_layers("color([1,0,0,0.5]) { difference() {"
                           "multmatrix([[1,0,0,-5],[0,1,0,9.97],[0,0,1,-5]]) { cube(10); }"
                           "sphere(r = 10, $fn = 30); } }"),
              ElementsAre("(0-1)"));
}

// Their intersection reaches a fiftieth of a pixel of the balls' picture.
TEST(LeafBoxes, AreTightAboutALens) {
  const csgcore::Box box =
      import_text(
          "intersection() { sphere(r = 10, $fn = 60);"
          "multmatrix([[1,0,0,19.9],[0,1,0,0],[0,0,1,0]]) { sphere(r = 10, $fn = 60); } }",
          for_picture(PictureKind::kRendered))
          .view_box;
  const double radius = std::sqrt(100 - 9.95 * 9.95);
  EXPECT_GE(box.size().y, 2 * radius);
  EXPECT_LT(box.size().y, 2.02 * radius);
  EXPECT_LT(box.size().x, 0.101);
}

// An extrusion of operations is one leaf, and OpenSCAD has the box of its outcome.
TEST(LeafBoxes, AreTightAboutExtrusionsOfManyEdges) {
  std::string text = "linear_extrude(height = 5) { difference() { square([100, 10]);";
  for (int i = 0; i < 40; ++i) {  // of more edges than rays should meet
    text += "multmatrix([[1,0,0," + std::to_string(50 + i) +
            "],[0,1,0,0],[0,0,1,0]]) { circle(r = 20, $fn = 60); }";
  }
  text += "multmatrix([[1,0,0,31],[0,1,0,-1],[0,0,1,0]]) { square([80, 20]); } } }";
  const csgcore::Box box = import_text(text).view_box;
  EXPECT_GE(box.max.x, 31);
  EXPECT_NEAR(box.max.x, 31, 0.02);
  expect_box(import_text("rotate_extrude($fn = 100) { difference() { square([100, 10]);"
                         "multmatrix([[1,0,0,31],[0,1,0,-1],[0,0,1,0]]) { square([80, 20]); } } }")
                 .view_box,
             Vec3(-31, -31, 0), Vec3(31, 31, 10), 0.02);
}

// A sheet beside a thick part: rays along it would miss it.
TEST(LeafBoxes, OfTheFinalRenderHoldSheets) {
  expect_box(import_text("multmatrix([[1,0,0,-40],[0,1,0,0],[0,0,1e-5,0]]) { cube(10); }"
                         "difference() { cube(10); multmatrix([[1,0,0,7],[0,1,0,-1],[0,0,1,-1]])"
                         "{ cube(12); } }",
                         for_picture(PictureKind::kRendered))
                 .view_box,
             Vec3(-40, 0, 0), Vec3(7, 10, 10), 1e-9);
}

TEST(ThrownTogether, ShowsEveryLeafWhole) {
  const auto text = "difference() { cube(); sphere(); } intersection() { cylinder(); sphere(); }";
  EXPECT_EQ(model_of(text, for_picture(PictureKind::kThrownTogether)), "(0+1+2+3)");
  EXPECT_THAT(cut_faces(text, PictureKind::kThrownTogether),
              ElementsAre(CutFaces::kNever, CutFaces::kAlways, CutFaces::kNever, CutFaces::kNever));
  EXPECT_THAT(model_layers(text, PictureKind::kThrownTogether), IsEmpty());
}

TEST(ThrownTogether, LeavesOutWhatNoProductHas) {
  const auto at = [](int x) {
    return "multmatrix([[1,0,0," + std::to_string(x) +
           "],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(); }";
  };
  EXPECT_EQ(model_of("intersection() { group() {" + at(0) + at(4) + "}" + at(2) + "}",
                     for_picture(PictureKind::kThrownTogether)),
            "-");
}

TEST(ThrownTogether, TranslucentAndHighlightedLeavesAreLayersOfTheirOwn) {
  EXPECT_THAT(model_layers("cube();" + kGlass + "sphere(); cube();", PictureKind::kThrownTogether),
              ElementsAre("0", "1", "(2+3)"));
  const csgcore::Scene scene =
      import_text("difference() { cube(); #sphere(); }", for_picture(PictureKind::kThrownTogether))
          .scene;
  ASSERT_THAT(scene.layers, SizeIs(3));
  EXPECT_EQ(scene.layers[0].kind, Layer::Kind::kModel);
  EXPECT_EQ(scene.layers[1].kind, Layer::Kind::kHighlight);  // as a leaf
  EXPECT_EQ(scene.layers[2].kind, Layer::Kind::kHighlight);  // and as an overlay
}

TEST(ThrownTogether, DrawsNoModelUnderALeafThatIsHighlighted) {
  const csgcore::Scene scene =
      import_text("#cube();", for_picture(PictureKind::kThrownTogether)).scene;
  ASSERT_THAT(scene.layers, SizeIs(3));
  EXPECT_EQ(scene.layers[0].kind, Layer::Kind::kModel);
  EXPECT_TRUE(scene.layers[0].solid.empty());
}

TEST(ThrownTogether, APlateShowsItsBottomUnlessASubtractedOneHidesIt) {
  const auto layers = [](const std::string& text) {
    return import_text(text, for_picture(PictureKind::kThrownTogether)).scene.layers;
  };
  EXPECT_TRUE(layers("square(9); %circle(3);").back().shows_behind);
  EXPECT_FALSE(layers("square(9); %sphere(3);").back().shows_behind);
  EXPECT_THAT(layers("difference() { square(9); #circle(3); }"), SizeIs(2));
}

TEST(ThrownTogether, FacesThatRunTheOtherWayHaveTheColorOfTheInside) {
  const std::string one_turned = "faces = [[0,1,2],[0,3,1],[0,2,3],[1,2,3]]";
  const ImportedDesign design = import_text("polyhedron(" + kCorner + one_turned + ");",
                                            for_picture(PictureKind::kThrownTogether));
  EXPECT_EQ(design.leaves, 1u);
  ASSERT_THAT(design.scene.primitives, SizeIs(2));
  EXPECT_EQ(design.scene.primitives[0].mesh()->triangles().size(), 3u);
  EXPECT_EQ(design.scene.primitives[0].color, std::nullopt);
  EXPECT_EQ(design.scene.primitives[1].mesh()->triangles().size(), 1u);
  EXPECT_EQ(design.scene.primitives[1].color, kSeenFromWithin);
}

TEST(ThrownTogether, AnInsideOutPolyhedronHasTheColorOfTheInside) {
  const auto color_of = [](const std::string& faces, PictureKind picture) {
    return import_text("polyhedron(" + kCorner + faces + ");", for_picture(picture))
        .scene.primitives.at(0)
        .color;
  };
  const std::string reversed = "faces = [[2,1,0],[1,3,0],[3,2,0],[2,3,1]]";
  EXPECT_EQ(color_of(reversed, PictureKind::kThrownTogether), kSeenFromWithin);
  EXPECT_EQ(color_of(kFaces, PictureKind::kThrownTogether), std::nullopt);
  EXPECT_EQ(color_of(reversed, PictureKind::kPreview), std::nullopt);
}

}  // namespace
}  // namespace frontend
