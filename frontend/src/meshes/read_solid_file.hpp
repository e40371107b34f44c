// The files of solids that OpenSCAD's import() reads.
#pragma once

#include <string>
#include <string_view>

#include "meshes/face_set.hpp"

namespace frontend {

/// What a file holds. After a problem there may be faces, too: those before it.
struct SolidFile {
  FaceSet faces;
  std::string problem;  // OpenSCAD's message where it has one; empty: none
};

/// These read the bytes of a file, whose name is for messages. No file makes them take memory or
/// time out of proportion to its size.

/// STL, binary if its length is that of its count of facets, and else text if it begins with
/// "solid". Anything else is empty, and so is a file without facets: the problem says why.
SolidFile read_stl(std::string_view bytes, const std::string& name);
/// OFF with or without colours and normals, which are ignored.
SolidFile read_off(std::string_view bytes, const std::string& name);
/// OFF by OpenSCAD 2026's rules: behind a face's corners r, g, b and perhaps alpha may stand, each
/// in 255ths, or as a share if it has a point. A corner without a point is left out, and told of.
SolidFile read_colored_off(std::string_view bytes, const std::string& name);
/// AMF, perhaps within a zip archive: the meshes of all objects. Units, colours and constellations
/// are ignored.
SolidFile read_amf(std::string_view bytes, const std::string& name);
/// 3MF: every mesh once. Its build items, transformations and units are ignored, as by OpenSCAD
/// 2021.01.
SolidFile read_3mf(std::string_view bytes, const std::string& name);
/// 3MF by OpenSCAD 2026's rules: what its build is made of, by meshes and components under their
/// transformations, with the colours of base materials and of colour groups. Units are ignored. One
/// that repeats parts so often that there would be more than 2^22 points cannot be read.
SolidFile read_built_3mf(std::string_view bytes, const std::string& name);
/// OBJ: its points and faces. A line that cannot be read is left out, and so is a corner that names
/// no point; the problem tells of the first.
SolidFile read_obj(std::string_view bytes, const std::string& name);
/// NEF3, the text that CGAL writes of a Nef polyhedron: the faces that have it on one side, seen
/// from the other. The coordinates in the text are fractions of whole numbers of any length; the
/// results are within a rounding of them, or two. Sheets and lines without thickness are left out.
SolidFile read_nef3(std::string_view bytes, const std::string& name);

}  // namespace frontend
