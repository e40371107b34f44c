// Sections of solids with the plane z = 0, as OpenSCAD's projection(cut = true) makes them.
#pragma once

#include "solids/operations.hpp"
#include "solids/solid_value.hpp"

namespace frontend {

struct Section {
  Operations<Figure> operations;
  bool has_open_mesh = false;  // such a mesh has no section
};

/// Returns the section. Solids are closed sets, whose faces in the plane belong to it, and OpenSCAD
/// takes the operations on them literally: so they commute with the section. What is round stays so
/// where its section is a circle.
Section section_of(const SolidValue& value);

}  // namespace frontend
