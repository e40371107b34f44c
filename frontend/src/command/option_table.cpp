#include "command/option_row.hpp"
#include "command/option_words.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {
namespace {

std::vector<std::string> scheme_names() {
  std::vector<std::string> names;
  for (const ColorScheme& scheme : color_schemes()) names.emplace_back(scheme.name);
  return names;
}

std::vector<std::string> format_names() {
  std::vector<std::string> names = names_of<kFormats>();
  for (const auto& word : kTextKinds) names.emplace_back(word.first);
  for (const auto& word : kModelFormats) names.emplace_back(word.first);
  names.insert(names.end(), std::begin(kHandedFormats), std::end(kHandedFormats));
  return names;
}

std::vector<std::string> summary_names() {
  std::vector<std::string> names = names_of<kSummaryParts>();
  names.emplace_back(kWholeSummary);
  return names;
}

constexpr Completion kAnyScheme{Completion::Kind::kWord, scheme_names};
constexpr Completion kViewList{Completion::Kind::kWordList, names_of<kViews>};

// Where OpenSCAD has a long name of one letter for a short option, so have we.
constexpr OptionRow kOpenScadOptions[] = {
    {"o,o", Takes::kTexts, "OUT",
     "what to write: a picture (.png, .exr), or all of an animation (.gif, .webp); the solid "
     "(.stl, .off, .obj, .3mf, .amf) or the plane "
     "figure (.svg, .dxf, .pdf); the evaluated design's tree (.csg) or messages (.echo), or its "
     "parameters (.param); or what the installed openscad writes (.wrl, .nef3, .ast, .term, .pov); "
     "- "
     "is standard output, with --export-format; may be given more than once",
     kAnyFile},
    {"export-format",
     Takes::kText,
     "FORMAT",
     "the format, whatever OUT's suffix is: that of a suffix, or asciistl or binstl (.stl's)",
     {Completion::Kind::kWord, format_names}},
    {"O,O", Takes::kTexts, "SETTING",
     "a setting of exported files, SECTION/KEY=VALUE; may be given more than once"},
    {"help-export", Takes::kNothing, "", "print the settings that -O takes"},
    {"imgsize", Takes::kText, "W,H", "size of the picture in pixels; default 512,512"},
    {"camera", Takes::kText, "NUMBERS",
     "translation x,y,z, rotation x,y,z in degrees, distance; or eye x,y,z, centre x,y,z; default: "
     "--viewall --autocenter"},
    {"viewall", Takes::kNothing, "", "take the distance at which the whole design is seen"},
    {"autocenter", Takes::kNothing, "", "with --viewall: look at the design's centre"},
    {"projection", Takes::kText, "P", "(o)rtho or (p)erspective, the default",
     kOneOf<kProjections>},
    {"colorscheme", Takes::kText, "NAME", "colour scheme:", kAnyScheme},
    {"view", Takes::kText, "WHAT",
     "axes, crosshairs, edges, grid, scales, wireframe, with commas between; scales with axes, "
     "wireframe with --render only",
     kViewList},
    {"animate", Takes::kText, "N",
     "N pictures of a .scad, $t from 0 to 1 - 1/N; a number is added to OUT's name; at most 4096 "
     "pictures in all"},
    {"animate_sharding", Takes::kText, "I/N",
     "the I-th of N parts of the frames of --animate alone"},
    kVariableOption,
    kParameterFileOption,
    kParameterSetOption,
    {"d,d", Takes::kText, "DEPS",
     "write a rule for make: the pictures, and all files that the design reads", kAnyFile},
    {"m,m", Takes::kText, "COMMAND", "make command for files that a .scad misses", kAnyCommand},
    {"hardwarnings", Takes::kNothing, "", "the design's first warning is an error"},
    {"check-parameters", Takes::kText, "BOOL",
     "check the parameters of a .scad's modules and functions", kOneOf<kTruthValues>},
    {"check-parameter-ranges", Takes::kText, "BOOL", "check the ranges of a .scad's parameters",
     kOneOf<kTruthValues>},
    {"trace-depth", Takes::kCount, "N",
     "the lines that tell the calls around an error of a 2026 design, at most; default 12"},
    {"trace-usermodule-parameters", Takes::kText, "BOOL",
     "have the parameters of modules among these lines", kOneOf<kTruthValues>},
    {"summary",
     Takes::kTexts,
     "WHAT",
     "tell figures of the solid or plane figure on standard error; may be given more than once:",
     {Completion::Kind::kWord, summary_names}},
    {"summary-file", Takes::kText, "FILE",
     "write the summary to FILE as JSON; - is standard output", kAnyFile},
    {"quiet,q", Takes::kNothing, "", "errors only"},
    {"info", Takes::kNothing, "",
     "log the renderer that is chosen; without FILE: describe this program"},
    kVersionOption,
    kHelpOption,
    {"render", Takes::kOptionalText, "HOW",
     "draw the solid alone: without color(), # and %; HOW has no effect"},
    {"preview", Takes::kOptionalText, "HOW",
     "draw with color(), # and %, the default; =throwntogether: every part whole, no operation"},
    {"backend", Takes::kText, "B", "accepted, without effect: there is one", kOneOf<kBackends>},
    {"csglimit", Takes::kCount, "N", "accepted, without effect: there is no limit"},
    {"debug", Takes::kText, "WHAT", "accepted, without effect"},
    {"enable", Takes::kTexts, "FEATURE",
     "lazy-union, or all: loops and blocks of a 2026 design make no groups; passed on to openscad"},
    {"reset-window-settings", Takes::kNothing, "", "have the window forget its settings"},
    {"trust-python", Takes::kNothing, "", "accepted, without effect: Python is not run"},
    {"python-module", Takes::kText, "MODULE", "accepted, without effect: Python is not run"},
    {"s,s", Takes::kText, "OUT", "the same as -o", kAnyFile},
    {"x,x", Takes::kText, "OUT", "the same as -o", kAnyFile},
};

constexpr OptionRow kOwnOptions[] = {
    {"renderer", Takes::kText, "R",
     "cpu, gl or auto, the default: OpenGL where there is a GPU, else the CPU", kOneOf<kRenderers>},
    {"technique", Takes::kText, "T",
     "how a ray finds what it may meet: by tiles of the screen (default), or the cells of a "
     "kd-tree (default with --leaf-primitives, --threshold and --show=cells)",
     kOneOf<kTechniques>},
    {"samples", Takes::kText, "N",
     "antialiasing: rays per pixel where there is an edge, 1 to 64; default 1"},
    {"leaf-primitives", Takes::kText, "K",
     "a cell is a leaf once at most K primitives' surfaces cross it; default 8"},
    {"threshold", Takes::kText, "PX",
     "cells that project below PX pixels are not subdivided; default 0: none"},
    kEvaluatorOption,
    kLanguageOption,
    {"facets", Takes::kText, "N",
     "what is round keeps OpenSCAD's facets where 0 < $fn <= N (default 8), all or none; the rest "
     "is exactly round",
     kOneOf<kFacets>},
    {"tolerance", Takes::kText, "T",
     "facets of what is exported are at most T from the round surface, and uncut ones have their "
     "corners on it; default: OpenSCAD's facets"},
    {"show", Takes::kText, "WHAT", "surface, cells, depth, normals or id; default surface",
     kOneOf<kShows>},
    {"shading", Takes::kText, "HOW",
     "openscad (default), phong or studio (the window's default): with occlusion, shadows and "
     "lines along edges",
     kOneOf<kShadings>},
    {"shadows", Takes::kText, "S", "how dark shadows are, 0 to 1; default 1 of studio, 0 of phong"},
    {"occlusion", Takes::kText, "S",
     "how dark the studio's corners and hollows are, 0 to 1; default 1"},
    {"edges", Takes::kText, "S", "how dark the studio's lines are, 0 to 1; default 1"},
    {"translucency", Takes::kText, "ORDER",
     "which of translucent parts are drawn over others: later ones of the file (default), as in "
     "OpenSCAD, or nearer ones, by depth (the window's default)",
     kOneOf<kTranslucencies>},
    {"turn", Takes::kNothing, "",
     "the camera of --animate goes once around the design, about its vertical axis"},
    {"fps", Takes::kText, "F",
     "frames a second of an animation in one file (.gif, .webp), up to 50; default 20"},
    {"editor", Takes::kText, "COMMAND",
     "the window's editor, a command line with {file}, {line} and {column}, or one whose form is "
     "known (code, subl, emacsclient, gvim, kate …); default: $SCADRAY_EDITOR, $VISUAL, $EDITOR",
     kAnyCommand},
    {"pan", Takes::kText, "HOW",
     "how far a drag pans in the window: with the mouse, or as openscad, some four times as far; "
     "default mouse",
     kOneOf<kPans>},
    {"stats", Takes::kText, "FILE", "counts and times as JSON; - is standard output", kAnyFile},
    {"echo", Takes::kNothing, "",
     "write what the design echoes to standard output; the window does after each save"},
    {"messages", Takes::kText, "HOW",
     "text, the default, or json: each message an object on a line, with group, text, file, line, "
     "column and trace",
     kOneOf<kMessageFormats>},
    kTimeoutOption,
    kSkipOption,
    kThreadsOption,
};

}  // namespace

std::span<const OptionRow> openscad_options() { return kOpenScadOptions; }

std::span<const OptionRow> own_options() { return kOwnOptions; }

}  // namespace frontend
