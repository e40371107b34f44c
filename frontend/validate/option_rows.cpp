#include "option_rows.hpp"

#include "command/option_words.hpp"

namespace validation {
namespace {

using frontend::OptionRow;
using frontend::Takes;

constexpr OptionRow kOptions[] = {
    {"fn", Takes::kText, "N", "fragments of the facets that CGAL is given, 3 to 200; default 8"},
    {"points", Takes::kText, "N", "random points of each kind; default 10000"},
    {"rays", Takes::kText, "N",
     "random rays of each kind, and for the volume ten times as many; default 10000"},
    {"views", Takes::kText, "N", "pictures of random views, 160 x 120 pixels; default 3"},
    {"seed", Takes::kText, "N", "of the random numbers; default 1"},
    {"time-limit", Takes::kText, "SECONDS",
     "a design that CGAL's polyhedra take longer for is compared with exact rays alone; default "
     "40"},
    {"renderer", Takes::kText, "R",
     "what is compared besides the CPU: cpu (nothing), gl, or auto, the default: OpenGL where "
     "there is a GPU",
     frontend::kOneOf<frontend::kRenderers>},
    {"report", Takes::kText, "FILE",
     "all that was found, with coordinates, as JSON; - is standard output", frontend::kAnyFile},
    frontend::kThreadsOption,
    frontend::kTimeoutOption,
    frontend::kSkipOption,
    frontend::kEvaluatorOption,
    frontend::kVariableOption,
    frontend::kParameterFileOption,
    frontend::kParameterSetOption,
    {"quiet,q", Takes::kNothing, "", "no table: errors, the report and the exit status only"},
    frontend::kVersionOption,
    frontend::kHelpOption,
};

}  // namespace

std::span<const OptionRow> option_rows() { return kOptions; }

}  // namespace validation
