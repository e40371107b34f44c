#include <cstdio>

#include "section.hpp"

namespace measure {
namespace {

constexpr Section kSections[] = {
    {"whole", "From file to PNG", measure_whole},
    {"error", "Time against error", measure_error},
    {"frames", "A moved camera", measure_frames},
    {"scale", "Scale", measure_scale},
    {"stability", "Numerical stability", measure_stability},
    {"opengl", "OpenGL", measure_opengl},
    {"paper", "The paper's measurements", measure_paper},
};

}  // namespace

std::span<const Section> sections() { return kSections; }

void say(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

void LeftOut::add(const std::string& what, const std::string& why) {
  reasons.push_back(what + ": " + why);
  say("left out: " + reasons.back());
}

}  // namespace measure
