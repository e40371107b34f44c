// The paper's measurements (§4.1, table 1 and figure 14), in ms, on its two machines: C1, a
// Pentium-M of 1.4 GHz with a GeForce FX Go5200; C2, an Athlon 64 3800+ with a GeForce 6800 GT.
// Pictures have 640 × 480 pixels, and the threshold is 1 pixel.
#pragma once

#include <cstdint>

namespace measure {

struct PaperTimes {
  double s, t_s, t_r, s_r;
};

struct PaperRow {
  const char* design;
  PaperTimes c1, c2;
  uint32_t draw_calls;  // 0: not said
};

constexpr PaperRow kPaperTable[] = {
    {"cs1000", {1739, 964, 10776, 11243}, {856, 505, 2086, 2314}, 85306},
    {"cc1000", {3705, 1265, 34975, 35233}, {2658, 626, 4324, 4820}, 103250},
    {"r9", {29, 19, 1626, 1677}, {20, 11, 78, 80}, 2068},
    {"t1022", {220, 86, 2464, 2466}, {162, 44, 319, 324}, 0},
};

/// T_R on C1, which figure 14 names for two of its points.
struct PaperPoint {
  uint32_t cones;
  double c1_t_r;
};
constexpr PaperPoint kPaperGrowth[] = {{500, 16046}, {1000, 34975}};

}  // namespace measure
