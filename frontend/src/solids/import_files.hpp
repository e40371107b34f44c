// The solids and drawings of the files that a design names.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "arguments/file_arguments.hpp"
#include "solids/import_polyhedra.hpp"

namespace frontend {

/// A file's solid, and what is wrong with it. The messages are OpenSCAD's where it has one.
struct ImportedFile {
  const SolidOfFaces* solid = nullptr;  // null: the empty set
  std::optional<csgcore::Color> color;  // that all of its faces have
  std::string problem;                  // empty: none
  std::string todo;
};

/// A file's figures, and what is wrong with it.
using ImportedDrawing = Drawing;

/// Returns whether import() knows the kind of the file, which its name tells.
bool is_importable(std::string_view name);

/// The kinds of file that is_importable() knows, for messages.
constexpr const char* kImportable = ".stl, .off, .amf, .3mf, .nef3, .svg or .dxf";

/// Reads every file of a design once, and a drawing once for each way of reading it.
class FileImports {
 public:
  /// Relative names are looked up in `folder`, in the working folder if it is empty. The pool must
  /// outlive this. `keeps_colors`: those of files count.
  FileImports(std::string folder, PolyhedronPool& pool, bool keeps_colors = true)
      : folder_(std::move(folder)), pool_(pool), keeps_colors_(keeps_colors) {}

  /// The results live as long as this. The kind of an import's file is told by its name.
  const ImportedFile& import(const FileArguments& arguments);
  const ImportedFile& surface(const FileArguments& arguments);
  const ImportedDrawing& drawing(const DrawingArguments& arguments);

  /// Returns the paths of all files that were asked for, each once, whether or not they are there.
  std::vector<std::string> paths() const { return {paths_.begin(), paths_.end()}; }

 private:
  std::string path_of(const std::string& name);
  ImportedFile read_import(const FileArguments& arguments);
  ImportedFile read_surface(const FileArguments& arguments);
  ImportedDrawing read_drawing(const DrawingArguments& arguments);
  void set_solid(FaceSet faces, const std::string& path, bool closes_gaps, ImportedFile& file);

  const std::string folder_;
  PolyhedronPool& pool_;
  const bool keeps_colors_;
  /// By the file and the settings.
  std::map<std::tuple<std::string, bool, bool>, ImportedFile> imports_, surfaces_;
  /// By the file and all settings: texts, and numbers.
  std::map<std::pair<std::vector<std::string>, std::vector<double>>, ImportedDrawing> drawings_;
  std::set<std::string> paths_;
};

}  // namespace frontend
