#include "option_rows.hpp"

#include "command/option_words.hpp"

namespace bench {
namespace {

using frontend::OptionRow;
using frontend::Takes;

constexpr OptionRow kOptions[] = {
    {"imgsize", Takes::kText, "W,H", "size of the pictures in pixels; default 640,480"},
    {"camera", Takes::kText, "NUMBERS",
     "where the camera begins to turn, as for a picture; default: --viewall --autocenter"},
    {"viewall", Takes::kNothing, "", "take the distance at which the whole design is seen"},
    {"autocenter", Takes::kNothing, "", "with --viewall: look at the design's centre"},
    {"projection", Takes::kText, "P", "(o)rtho or (p)erspective, the default",
     frontend::kOneOf<frontend::kProjections>},
    {"renderer", Takes::kText, "R",
     "what is measured: cpu, gl, or auto, the default: the CPU, and OpenGL, on a GPU or in "
     "software, where it can be had",
     frontend::kOneOf<frontend::kRenderers>},
    {"leaf-primitives", Takes::kText, "K",
     "a cell is a leaf once at most K primitives' surfaces cross it; default: both 8 without a "
     "threshold, and the paper's rule, 2 and 1 pixel"},
    {"threshold", Takes::kText, "PX", "cells that project below PX pixels are not subdivided"},
    {"repeat", Takes::kText, "N", "measure everything at least N times; default 5"},
    {"time", Takes::kText, "SECONDS", "and until it took so long in all; default 1"},
    {"json", Takes::kNothing, "", "JSON instead of tables"},
    frontend::kThreadsOption,
    frontend::kTimeoutOption,
    frontend::kSkipOption,
    frontend::kEvaluatorOption,
    frontend::kVariableOption,
    frontend::kParameterFileOption,
    frontend::kParameterSetOption,
    {"quiet,q", Takes::kNothing, "", "no warnings: the times and errors only"},
    frontend::kVersionOption,
    frontend::kHelpOption,
};

}  // namespace

std::span<const OptionRow> option_rows() { return kOptions; }

}  // namespace bench
