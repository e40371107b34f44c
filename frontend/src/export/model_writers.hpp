// The writers of the formats. Each returns the bytes of a file, laid out as OpenSCAD 2021.01 does
// where it has the format. Numbers have all of their digits.
#pragma once

#include <span>
#include <string>

#include "csgcore/boundary_mesh.hpp"
#include "frontend/export_settings.hpp"
#include "frontend/exported_part.hpp"
#include "plane/figure.hpp"

namespace frontend {

/// These write floats: a surface's coordinates are rounded to them before (written_mesh.hpp).
std::string stl_of(const csgcore::TriangleSet& surface);
std::string ascii_stl_of(const csgcore::TriangleSet& surface);
std::string obj_of(const csgcore::TriangleSet& surface);
std::string amf_of(const csgcore::TriangleSet& surface);
/// Has an object for each part, with its colour as a material, and one of all parts if they are
/// several. There is one part at least.
std::string three_mf_of(std::span<const ExportedPart> parts, const ExportSettings& settings = {});

/// Writes doubles.
std::string off_of(const csgcore::TriangleSet& surface);

/// These write the outlines of a plane figure, of which there is one at least.
std::string svg_of(const Polygons& outlines, const ExportSettings& settings = {});
std::string dxf_of(const Polygons& outlines);
/// Has one page, as large as the paper or larger, with the origin in its middle.
std::string pdf_of(const Polygons& outlines, const ExportSettings& settings = {});

/// Returns the text with XML's special characters as entities.
std::string xml_text(const std::string& text);

}  // namespace frontend
