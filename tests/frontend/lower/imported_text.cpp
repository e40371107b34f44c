#include "lower/imported_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "csgcore/polyhedron.hpp"
#include "frontend/parser.hpp"

namespace frontend {

using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;
using ::testing::SizeIs;

ImportedDesign import_text(const std::string& text, ImportOptions options) {
  return import_design(parse(text, "a.csg"), options);
}

std::string error_of(const std::string& text) {
  try {
    import_text(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::vector<std::string> warnings_of(const std::string& text) {
  std::vector<std::string> texts;
  for (const Warning& warning : import_text(text).warnings) texts.push_back(warning.text);
  return texts;
}

std::string warning_of(const std::string& text) {
  const std::vector<std::string> texts = warnings_of(text);
  EXPECT_THAT(texts, SizeIs(1)) << text;
  return texts.empty() ? "" : texts.front();
}

std::string shape_of(const csgcore::CsgTree& tree, const std::vector<Primitive>& primitives) {
  std::vector<std::string> stack;
  for (const csgcore::CsgToken& token : tree.tokens()) {
    if (token.is_primitive) {
      stack.push_back(std::to_string(primitives.at(token.value).id));
      continue;
    }
    constexpr char kSigns[] = {'+', '*', '-'};
    std::string text = "(";
    for (size_t i = stack.size() - token.value; i < stack.size(); ++i) {
      if (text.size() > 1) text += kSigns[static_cast<size_t>(token.op)];
      text += stack[i];
    }
    stack.resize(stack.size() - token.value);
    stack.push_back(text + ")");
  }
  return stack.empty() ? "-" : stack.back();
}

std::string model_of(const std::string& text, ImportOptions options) {
  const ImportedDesign design = import_text(text, options);
  return shape_of(design.scene.model, design.scene.primitives);
}

std::string layers_of(const csgcore::Scene& scene, csgcore::Layer::Kind kind) {
  std::vector<std::string> shapes;
  for (const csgcore::Layer& layer : scene.layers) {
    if (layer.kind == kind) shapes.push_back(shape_of(layer.solid, scene.primitives));
  }
  if (shapes.empty()) return "-";
  std::string text = shapes[0];
  for (size_t i = 1; i < shapes.size(); ++i) text += "+" + shapes[i];
  return shapes.size() == 1 ? text : "(" + text + ")";
}

std::string trees_of(const std::string& text, ImportOptions options) {
  const csgcore::Scene scene = import_text(text, options).scene;
  return shape_of(scene.model, scene.primitives) + " | " +
         layers_of(scene, csgcore::Layer::Kind::kBackground) + " | " +
         layers_of(scene, csgcore::Layer::Kind::kHighlight);
}

Primitive only_primitive(const std::string& text) {
  const ImportedDesign design = import_text(text);
  EXPECT_THAT(design.scene.primitives, SizeIs(1)) << text;
  return design.scene.primitives.empty() ? Primitive{} : design.scene.primitives[0];
}

csgcore::Box box_of(const Primitive& primitive) {
  EXPECT_EQ(primitive.shape(), Shape::kPolyhedron);
  csgcore::Box box;
  if (!primitive.polyhedron()) return box;
  for (const Vec3& vertex : primitive.polyhedron()->vertices()) {
    box.merge(primitive.local_to_world.point(vertex));
  }
  return box;
}

void expect_box(const csgcore::Box& box, const Vec3& min, const Vec3& max, double tolerance) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(box.min[i], min[i], tolerance) << i;
    EXPECT_NEAR(box.max[i], max[i], tolerance) << i;
  }
}

}  // namespace frontend
