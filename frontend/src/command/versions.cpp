#include "command/versions.hpp"

#include <cstdio>

namespace frontend {

void print_version() {
  std::printf("scadray version %s\nlanguages of OpenSCAD: 2026 (default), 2021.01\n",
              SCADRAY_VERSION);
}

void print_info() {
  std::printf(
      "scadray %s\npictures: PNG (ISA-L), EXR (OpenEXR), GIF (giflib), WebP (libwebp)\nrenderers: "
      "%s\n.scad by: %s\n",
      SCADRAY_VERSION, SCADRAY_RENDERERS,
      "scadray itself, or openscad (on PATH, or $SCADRAY_OPENSCAD)");
}

}  // namespace frontend
