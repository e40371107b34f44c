#include "solids/import_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>

#include "base/lower_case.hpp"
#include "base/primitive_traits.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "meshes/height_map.hpp"
#include "meshes/read_solid_file.hpp"

namespace frontend {
namespace {

using ReadFile = SolidFile (*)(std::string_view bytes, const std::string& name);
struct Format {
  std::string_view suffix;
  ReadFile read;          // by 2021.01's rules; null: it does not know the format
  ReadFile read_by_2026;  // by 2026's
};
constexpr std::array<Format, 6> kFormats{{{".stl", read_stl, read_stl},
                                          {".off", read_off, read_colored_off},
                                          {".amf", read_amf, read_amf},
                                          {".3mf", read_3mf, read_built_3mf},
                                          {".nef3", read_nef3, read_nef3},
                                          {".obj", nullptr, read_obj}}};

/// Returns the format of a solid's file, or the end of the list.
auto format_of_solid(std::string_view name) {
  const std::string suffix = lower_case(std::filesystem::path(name).extension().string());
  return std::ranges::find(kFormats, suffix, &Format::suffix);
}

/// Returns what reads a file of that name; null if nothing does.
ReadFile reader_of(std::string_view name, bool is_of_2026) {
  const auto* const format = format_of_solid(name);
  if (format == kFormats.end()) return nullptr;
  return is_of_2026 ? format->read_by_2026 : format->read;
}

/// Moves the middle of the faces' box to the origin.
void move_to_middle(FaceSet& faces) {
  csgcore::Box box;
  for (const uint32_t corner : faces.corners) box.merge(faces.points[corner]);
  if (box.empty()) return;
  for (csgcore::Vec3& point : faces.points) point -= box.center();
}

/// Returns nothing if there is no such file, or it cannot be read.
std::optional<FileText> bytes_of_file(const std::string& path) {
  try {
    return read_regular_file(path);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

bool is_importable(std::string_view name) {
  return reader_of(name, false) != nullptr || drawing_format_of(name).has_value();
}

std::string FileImports::path_of(const std::string& name) {
  std::string path = (std::filesystem::path(folder_) / name).lexically_normal().string();
  paths_.insert(path);
  return path;
}

const ImportedFile& FileImports::import(const FileArguments& arguments) {
  const auto [entry, is_new] =
      imports_.try_emplace({arguments.file, arguments.is_centered, arguments.is_of_2026});
  if (is_new) entry->second = read_import(arguments);
  return entry->second;
}

const ImportedFile& FileImports::surface(const FileArguments& arguments) {
  const auto [entry, is_new] =
      surfaces_.try_emplace({arguments.file, arguments.is_centered, arguments.is_inverted});
  if (is_new) entry->second = read_surface(arguments);
  return entry->second;
}

const ImportedDrawing& FileImports::drawing(const DrawingArguments& arguments) {
  const DxfSettings& dxf = arguments.dxf;
  const SvgSettings& svg = arguments.svg;
  std::vector<double> numbers{static_cast<double>(arguments.format),
                              dxf.origin.x,
                              dxf.origin.y,
                              dxf.scale,
                              dxf.facets.fn,
                              dxf.facets.fa,
                              dxf.facets.fs,
                              dxf.facets.tolerance,
                              static_cast<double>(dxf.is_faceted),
                              static_cast<double>(dxf.is_centered),
                              static_cast<double>(svg.is_centered),
                              svg.dpi,
                              static_cast<double>(svg.is_faceted),
                              static_cast<double>(svg.language),
                              static_cast<double>(svg.id.has_value()),
                              static_cast<double>(svg.layer.has_value()),
                              svg.facets.fn,
                              svg.facets.fa,
                              svg.facets.fs,
                              svg.facets.tolerance};
  // No nan, which equals nothing.
  for (double& number : numbers) number = std::isnan(number) ? 0 : number;
  std::vector<std::string> texts{arguments.file, dxf.layer, svg.id.value_or(""),
                                 svg.layer.value_or("")};
  const auto [entry, is_new] = drawings_.try_emplace({std::move(texts), std::move(numbers)});
  if (is_new) entry->second = read_drawing(arguments);
  return entry->second;
}

ImportedDrawing FileImports::read_drawing(const DrawingArguments& arguments) {
  const std::string path = path_of(arguments.file);
  const bool is_dxf = arguments.format == DrawingFormat::kDxf;
  const std::optional<FileText> bytes = bytes_of_file(path);
  if (!bytes) {
    return {{},
            {{std::string(is_dxf ? "Can't open DXF file '" : "Can't open file '") + path + "'",
              "check its name; it is relative to the design's folder"}}};
  }
  if (!is_dxf) return read_svg(bytes->view(), path, arguments.svg);
  ImportedDrawing drawing = read_dxf(bytes->view(), path, arguments.dxf);
  if (arguments.dxf.is_centered) move_middle_to(Vec2(0.0), drawing.figures);
  return drawing;
}

ImportedFile FileImports::read_import(const FileArguments& arguments) {
  ImportedFile file;
  const std::string& name = arguments.file;
  const std::string path = path_of(name);
  const ReadFile read = reader_of(name, arguments.is_of_2026);
  if (read == nullptr) {
    file.problem = "Unsupported file format while trying to import file '\"" + name + "\"'";
    file.todo = std::string("convert it to ") + kImportable;
    return file;
  }
  const std::optional<FileText> bytes = bytes_of_file(path);
  if (!bytes) {
    file.problem = "Can't open import file '" + path + "'";
    file.todo = "check its name; it is relative to the design's folder";
    return file;
  }
  SolidFile solid = read(bytes->view(), path);
  if (arguments.is_centered) move_to_middle(solid.faces);
  file.color = take_common_color(solid.faces);
  if (!keeps_colors_) {
    file.color.reset();
    solid.faces.colors.clear();
  }
  file.problem = std::move(solid.problem);
  if (!file.problem.empty()) file.todo = "the file is damaged: export it again";
  set_solid(std::move(solid.faces), path, arguments.is_of_2026, file);
  return file;
}

ImportedFile FileImports::read_surface(const FileArguments& arguments) {
  ImportedFile file;
  const std::string path = path_of(arguments.file);
  const std::optional<FileText> bytes = bytes_of_file(path);
  if (!bytes) {
    file.problem = "The file '" + path + "' couldn't be opened";
    file.todo = "check its name; it is relative to the design's folder";
    return file;
  }
  HeightMap map = read_height_map(bytes->view(), path, arguments.is_inverted);
  file.problem = std::move(map.problem);
  if (!file.problem.empty()) file.todo = "check the file";
  set_solid(solid_below(map, arguments.is_centered), path, false, file);
  return file;
}

void FileImports::set_solid(FaceSet faces, const std::string& path, bool closes_gaps,
                            ImportedFile& file) {
  uint64_t unfinite_faces = 0;
  const SolidOfFaces& solid = pool_.solid(std::move(faces), unfinite_faces, closes_gaps);
  const bool is_too_large = solid.exponent > kLargestExponent;
  if (!solid.is_empty() && !is_too_large) file.solid = &solid;
  if (is_too_large && file.problem.empty()) {
    file.problem = "'" + path + "' is left out: its coordinates are too large";
    file.todo = "scale it to between 1e-90 and 1e90 across";
    return;
  }
  if (unfinite_faces == 0 || !file.problem.empty()) return;
  file.problem = std::to_string(unfinite_faces) + (unfinite_faces == 1 ? " face" : " faces") +
                 " of '" + path + "' with coordinates that are not finite " +
                 (unfinite_faces == 1 ? "is" : "are") + " left out";
  file.todo = "export it again";
}

}  // namespace frontend
