// NEF3: a solid with exact numbers, as CGAL writes it.
#include "meshes/nef_text.hpp"
#include "meshes/read_solid_file.hpp"

namespace frontend {

SolidFile read_nef3(std::string_view bytes, const std::string& name) {
  SolidFile file;
  if (std::optional<RingedFaces> faces = read_nef_text(bytes)) {
    file.faces = face_set_of(std::move(*faces));
  } else {
    file.problem = "Failure trying to import '" + name + "'";
  }
  return file;
}

}  // namespace frontend
