// .scad → .csg by the installed OpenSCAD.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "frontend/file_text.hpp"

namespace frontend {

struct OpenScadExport {
  FileText csg;
  std::vector<std::string> files;  // that the design reads, as openscad names them; if wanted
};

/// Runs `openscad` (the program that $OPENSCAD names, or else the one on PATH) on a .scad file and
/// returns the .csg that it has written when it ends, or a part of it that cannot be parsed,
/// whatever comes after it (is_beyond_repair() in parser.hpp). `arguments` are handed on as they
/// are. Each line that it says is given to `message` as it comes, a very long one in pieces.
/// `waiting` is called about ten times a second. Throws Error where openscad is missing, fails,
/// reports an error (it may exit 0 all the same), or writes nothing; and, at once, Stopped
/// (stop.hpp) where `stop` asks for it. openscad and all that it started is gone in each case, also
/// where this program is killed.
OpenScadExport export_with_openscad(const std::string& scad_path,
                                    const std::vector<std::string>& arguments, bool wants_files,
                                    const std::function<void(const std::string&)>& message,
                                    const std::function<void()>& waiting,
                                    const std::stop_token& stop = {});

}  // namespace frontend
