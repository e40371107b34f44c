// Imports the text of a .csg, and answers the questions of the importer's tests.
#pragma once

#include <string>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/csg_tree.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/solid.hpp"
#include "frontend/importer.hpp"

namespace frontend {

ImportedDesign import_text(const std::string& text, ImportOptions options = {});

/// Returns the message that import_text() throws; "no error" if nothing.
std::string error_of(const std::string& text);

std::vector<std::string> warnings_of(const std::string& text);

/// Returns the warning; there must be exactly one.
std::string warning_of(const std::string& text);

/// Writes the tree with its primitives' ids: "(0-1-(2+3))", "-" for the empty set.
std::string shape_of(const csgcore::CsgTree& tree,
                     const std::vector<csgcore::Primitive>& primitives);

std::string model_of(const std::string& text, ImportOptions options = {});

/// Writes the layers of a kind, one after another: "((0-1)+2)", "-" if there is none.
std::string layers_of(const csgcore::Scene& scene, csgcore::Layer::Kind kind);

/// Writes "model | background | highlight".
std::string trees_of(const std::string& text, ImportOptions options = {});

csgcore::Primitive only_primitive(const std::string& text);

/// Returns the box in the world of a primitive, which must be a polyhedron.
csgcore::Box box_of(const csgcore::Primitive& primitive);

/// Tells what is inside of a design.
class Inside {
 public:
  explicit Inside(const std::string& text, ImportOptions options = {})
      : design_(import_text(text, options)),
        solid_(csgcore::canonical_primitives(design_.scene), design_.scene.model) {}

  bool operator()(double x, double y, double z) const {
    return solid_.contains(csgcore::Vec3(x, y, z));
  }
  const ImportedDesign& design() const { return design_; }

 private:
  ImportedDesign design_;
  csgcore::Solid solid_;
};

void expect_box(const csgcore::Box& box, const csgcore::Vec3& min, const csgcore::Vec3& max,
                double tolerance);

// A tetrahedron; its faces are clockwise seen from outside.
inline const std::string kCorner = "points = [[0,0,0],[3,0,0],[0,4,0],[0,0,5]], ";
inline const std::string kFaces = "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]";

}  // namespace frontend
