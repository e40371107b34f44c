// What a design's file is, by its name.
#pragma once

#include <cstdint>
#include <string>

namespace frontend {

enum class DesignKind : uint8_t {
  kCsg,
  kScad,      // which has to be evaluated
  kImported,  // a mesh or a drawing, which is shown as import() shows it
  kEither,    // its text tells whether it is a .csg or a .scad: standard input, and the temporary
              // files without a suffix that editors' plugins pass
};

DesignKind kind_of(const std::string& path);

}  // namespace frontend
