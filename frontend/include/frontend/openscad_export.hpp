// Exports a .scad to a .csg by the installed OpenSCAD.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "frontend/design_file_options.hpp"
#include "frontend/file_text.hpp"

namespace frontend {

struct OpenScadExport {
  FileText csg;
  std::vector<std::string> files;  // files the design reads, as openscad names them
};

/// Runs openscad (openscad_program()) on a .scad file and returns the .csg that it writes. The
/// result may be only a start of it, if that start shows that the .csg cannot be parsed
/// (is_beyond_repair() in parser.hpp). `arguments` are passed on, but for those that the program
/// does not know. openscad reads `text` in place of the file, where there is one. `message` is
/// called with each line that openscad prints; a very long line comes in pieces. `waiting` is
/// called about ten times a second.
///
/// Throws Error if openscad is missing, fails, reports an error (which it may do with exit code 0),
/// or writes nothing. Throws Stopped (stop.hpp) as soon as `stop` is requested. In every case
/// openscad and everything that it has started have ended when this function returns or throws;
/// they also end if this program is killed.
OpenScadExport export_with_openscad(const std::string& scad_path,
                                    const std::vector<std::string>& arguments,
                                    const DesignMessageSink& message,
                                    const std::function<void()>& waiting,
                                    const std::stop_token& stop = {},
                                    const std::optional<FileText>& text = {});

}  // namespace frontend
