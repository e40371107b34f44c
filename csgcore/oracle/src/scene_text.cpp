#include "exact_twin.hpp"
#include "number_text.hpp"
#include "oracle/minimise.hpp"
#include "tree_order.hpp"

namespace oracle {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::Scene;
using csgcore::Vec3;

// --- C++ ---

std::string cpp_of(const Vec3& v) { return "Vec3(" + coordinates(v) + ")"; }

std::string cpp_of(const Affine& map) {
  const Mat3& m = map.linear;
  const std::string linear =
      m == Mat3(1.0) ? "Mat3(1.0)"
                     : "Mat3(" + cpp_of(m[0]) + ", " + cpp_of(m[1]) + ", " + cpp_of(m[2]) + ")";
  return "{" + linear + ", " + cpp_of(map.translation) + "}";
}

struct CppTree {
  void open(Op op) {
    const char* const names[] = {"kUnion", "kIntersection", "kDifference"};
    text += std::string("builder.open(Op::") + names[size_t(op)] + ");\n";
  }
  void primitive(uint32_t index) { text += "builder.primitive(" + std::to_string(index) + ");\n"; }
  void close() { text += "builder.close();\n"; }
  std::string text;
};

// --- OpenSCAD ---

std::string scad_of(const Affine& map) {
  if (map.linear == Mat3(1.0) && map.translation == Vec3(0.0)) return "";
  if (map.linear == Mat3(1.0)) return "translate([" + coordinates(map.translation) + "]) ";
  std::string rows;
  for (int row = 0; row < 3; ++row) {
    rows +=
        "[" +
        joined({map.linear[0][row], map.linear[1][row], map.linear[2][row], map.translation[row]}) +
        "], ";
  }
  return "multmatrix([" + rows + "[0, 0, 0, 1]]) ";
}

struct ScadTree {
  explicit ScadTree(const Scene& of) : scene(of) {}
  void line(const std::string& content) { text += std::string(2 * depth, ' ') + content + "\n"; }
  void open(Op op) {
    const char* const names[] = {"union", "intersection", "difference"};
    line(std::string(names[size_t(op)]) + "() {");
    ++depth;
  }
  void primitive(uint32_t index) {
    const Primitive& p = scene.primitives[index];
    line(scad_of(p.local_to_world) + twin_of(p.shape()).as_openscad(p) + ";");
  }
  void close() {
    --depth;
    line("}");
  }
  const Scene& scene;
  std::string text;
  size_t depth = 0;
};

}  // namespace

std::string as_cpp(const Scene& scene) {
  std::string text = "Scene scene;\nscene.primitives = {";
  for (size_t i = 0; i < scene.primitives.size(); ++i) {
    const Primitive& p = scene.primitives[i];
    text += (i > 0 ? ",\n    " : "\n    ") + twin_of(p.shape()).as_cpp(p, cpp_of(p.local_to_world));
  }
  text += "};\nCsgTreeBuilder builder;\n";
  CppTree tree;
  visit_outside_in(scene.model.tokens(), tree);
  return text + tree.text + "scene.model = builder.finish();\n";
}

std::string as_openscad(const Scene& scene) {
  ScadTree tree(scene);
  visit_outside_in(scene.model.tokens(), tree);
  return tree.text;
}

}  // namespace oracle
