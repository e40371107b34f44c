#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "arguments/value_text.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The points of the values, nan where a value is none.
std::vector<Vec3> points_of(const ValueList& values) {
  std::vector<Vec3> points;
  points.reserve(values.size());
  for (const ArgumentValue value : values) {
    points.push_back(vector_of(value, 2).value_or(Vec3(std::numeric_limits<double>::quiet_NaN())));
  }
  return points;
}

/// Reads the faces of a polyhedron one by one.
class FaceReader {
 public:
  FaceReader(NodeReader& reader, const ValueList& points) : reader_(reader), points_(points) {
    faces_.points = points_of(points);
  }

  FaceSet read(const ValueList& faces) {
    faces_.ends.reserve(faces.size());
    faces_.corners.reserve(3 * faces.size());
    for (size_t i = 0; i < faces.size(); ++i) {
      if (!faces[i].is_list()) {
        reader_.tell_wrong("a face", std::string(name_of(faces[i].kind())), "is left out",
                           "a list of indices of points");
        continue;
      }
      const size_t begin = faces_.corners.size();
      const bool goes_on = read_face(faces[i].elements(), i);
      // The first corner stays the first: one that crosses itself is cut into triangles there.
      if (begin < faces_.corners.size()) {
        std::reverse(faces_.corners.begin() + static_cast<std::ptrdiff_t>(begin) + 1,
                     faces_.corners.end());
      }
      faces_.end_face();
      if (!goes_on) break;
    }
    reader_.tell_first(beyond_points_);
    return std::move(faces_);
  }

 private:
  /// Returns false if a point is none.
  bool read_face(const ValueList& corners, size_t face) {
    for (size_t i = 0; i < corners.size(); ++i) {
      const std::optional<uint32_t> index = read_index(corners[i], face, i);
      if (!index) continue;
      if (!is_finite(faces_.points[*index])) {
        note_bad_point(*index);
        return false;
      }
      faces_.corners.push_back(*index);
    }
    return true;
  }

  /// Returns the point that a value names; none where it is beyond the points.
  std::optional<uint32_t> read_index(const ArgumentValue& value, size_t face, size_t place) {
    if (!value.is_number()) {
      reader_.tell_wrong("an index of a face", std::string(name_of(value.kind())), "counts as 0",
                         "a number");
    }
    const double number = value.is_number() ? value.number() : 0;
    if (number > -1 && number < static_cast<double>(points_.size())) {
      return static_cast<uint32_t>(number);
    }
    beyond_points_.add([&] {
      return NodeProblems::Description{
          ": Point index " + short_text(value) + " is out of bounds (from faces[" +
              std::to_string(face) + "][" + std::to_string(place) + "]), and is left out",
          points_.empty() ? "there are no points"
                          : "the points are 0 to " + std::to_string(points_.size() - 1)};
    });
    return std::nullopt;
  }

  void note_bad_point(uint32_t index) {
    reader_.tell({": Unable to convert points[" + std::to_string(index) +
                      "] = " + short_text(points_[index]) +
                      " to a vec3 of numbers, and the faces from there on are "
                      "left out",
                  "it must be a list of three finite numbers"});
  }

  NodeReader& reader_;
  const ValueList points_;
  ElementProblem beyond_points_;
  FaceSet faces_;
};

/// The faces, which the file lists clockwise as seen from outside. `faces` goes before `triangles`,
/// its older name. A point without a z lies at 0. As in OpenSCAD 2021.01 (frontend/OPENSCAD.md,
/// "Polyhedra"), an index beyond the points is left out, one that is no number is 0, and a point
/// that is none ends the faces where the first of them has it: what follows is lost. All points
/// that the faces have are finite.
FaceSet read_polyhedron(NodeReader& reader) {
  const ValueList points = reader.list("points", 0);
  ValueList faces = reader.list("faces", 1);
  if (faces.empty()) faces = reader.list("triangles", NodeReader::kByNameOnly);
  return FaceReader(reader, points).read(faces);
}

}  // namespace

const NodeRow kPolyhedronRow{
    .role = Role::kSolid,
    .dimension = 3,
    .counted = "faces",
    .read = [](NodeReader& reader, const NodeSources&) -> NodeData {
      return std::make_shared<const FaceSet>(read_polyhedron(reader));
    },
};

}  // namespace frontend
