// Scenes with pieces, gaps and wedges about as thick as the tolerance: which of them exist has to
// be decided exactly as by the reference.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "cases.hpp"
#include "csgcore/tracer.hpp"
#include "support/reference.hpp"

namespace stress {
namespace {

constexpr std::array<double, 8> kShares{0.2, 0.7, 0.99, 1.01, 1.3, 2, 7, 50};  // tolerances

/// Returns the tolerance of a model that has the part's box, to all digits that matter.
double tolerance_of(const Part& part) {
  return csgcore::thickness_tolerance(csgcore::reference_box(part.scene()));
}

/// Puts the results of `make`, one for the thickness of each share, side by side on a base that
/// fixes the model's size.
template <typename Make>
Scene side_by_side(Make&& make) {
  const Part base = rod(-3, -2, 10);
  std::vector<Part> parts{base + rod(-1, 1, 0.1)};
  const double tolerance = tolerance_of(all_of(parts));
  for (size_t i = 0; i < kShares.size(); ++i) {
    const double angle = double(i) * 2 * M_PI / kShares.size();
    const Part one = make(kShares[i] * tolerance);
    parts.push_back(one.at({6 * std::cos(angle), 6 * std::sin(angle), 0}));
  }
  return all_of(parts).scene();
}

Scene skins() {
  return side_by_side([](double thickness) { return rod(-1, 1, 2) - rod(-2, 1 - thickness, 3); });
}

/// A sheet on a block; the block comes first in the file.
Scene sheets() {
  return side_by_side([](double thickness) { return rod(-1, 1, 2) + rod(1, 1 + thickness, 1); });
}

/// The same on two coincident blocks, each of which is seen wherever the other is.
Scene sheets_on_pairs() {
  return side_by_side([](double thickness) {
    return rod(1, 1 + thickness, 1) + (rod(-1, 1, 2) + rod(-1, 1, 1.5));
  });
}

/// What a ball leaves of an equal ball, if it is a bit smaller or moved a bit.
Scene shells() {
  return side_by_side([](double thickness) { return ball(2) - ball(2 - thickness); });
}
Scene crescents() {
  return side_by_side([](double thickness) {
    return ball(2) - ball(2, {0, 0.6 * thickness, -0.8 * thickness});
  });
}

/// A gap down to the floor, which exists if the floor is seen through it.
Scene gaps() {
  return side_by_side([](double thickness) {
    return rod(-1, 1, 2) - (rod(-2, 2, 1) - rod(-3, 3, 1 - thickness)) - rod(-1, 0, 1.9);
  });
}

/// Tops one above the other, each by that much, of which the topmost and the lowest decide.
Scene chains() {
  return side_by_side([](double step) {
    std::vector<Part> links;
    for (int i = 1; i < 5; ++i) links.push_back(rod(-2, 1 - i * step, 3));
    return rod(-1, 1, 2) - rod(-2, 1 - 5 * step, 3) - common_of(links);
  });
}

/// Blocks whose tops cross at angles (rad) of some tolerances per length, so that they coincide
/// near the line where they cross.
Scene wedges() {
  std::vector<Part> parts;
  int i = 0;
  for (const double angle : {1e-9, 1e-8, 1e-7, 1e-6, 1e-4}) {
    const Mat3 tilted{Vec3{1, 0, angle}, Vec3{0, 1, 0}, Vec3{-angle, 0, 1}};
    const Part level = rod(-1, 0, 2);
    const Part other = rod(-1, 0, 2).under({tilted, Vec3{0.0}});
    const Vec3 offset{5.0 * i++, 0, 0};
    parts.push_back((level + other).at(offset));
    parts.push_back((level - other).at(offset + Vec3{0, 5, 0}));
    parts.push_back((level * other).at(offset + Vec3{0, 10, 0}));
  }
  return all_of(parts).scene();
}

/// A rod and the plate that it is stuck in; the rod comes first.
Part rod_in_a_plate() { return rod(-0.5, 2, 1) + rod(-1, 0, 10); }

/// Sees the last of the plate before the rod, at so flat an angle that the foot of the rod's wall
/// is within the tolerance of the plate along the plate's normal, but not along the wall's.
std::vector<Camera> foot_cameras(const Scene& scene, PictureSize size) {
  const double tolerance = csgcore::thickness_tolerance(csgcore::reference_box(scene));
  std::vector<Camera> cameras;
  for (const double slope : {1e-3, 1e-4, 1e-5}) {
    View view;
    view.projection = Projection::kOrthographic;
    view.forward = glm::normalize(Vec3{1, 0, -slope});
    view.right = {0, -1, 0};
    view.up = glm::cross(view.right, view.forward);
    view.eye = Vec3{-1, 0, 0} - 4.0 * view.forward;
    view.half_height = 3 * tolerance;
    view.width_px = size.width_px;
    view.height_px = size.height_px;
    cameras.push_back({"slope " + std::to_string(slope), view});
  }
  return cameras;
}

/// A needle, `share` tolerances in radius, in the middle of a plate.
Case hair(double share) {
  const auto make = [share] {
    const Part plate = rod(-1, 0, 10);
    return (plate + rod(0, 1, share * tolerance_of(plate))).scene();
  };
  const auto cameras = [](const Scene& scene, PictureSize size) {
    const double tolerance = csgcore::thickness_tolerance(csgcore::reference_box(scene));
    std::vector<Camera> result;
    for (const double above_deg : {0.0, 20.0, 70.0}) {
      const Box about{Vec3{-tolerance, -tolerance, 0.5 - tolerance},
                      Vec3{tolerance, tolerance, 0.5 + tolerance}};
      View view = view_around(about, size, Projection::kOrthographic, 33, above_deg, 3);
      view.eye = about.center() - 5.0 * view.forward;
      result.push_back({std::to_string(int(above_deg)) + " deg", view});
    }
    return result;
  };
  char name[32];
  std::snprintf(name, sizeof(name), "hair_of_%g", share);
  return {name, make, cameras};
}

}  // namespace

Family tolerance_family() {
  return {"tolerance",
          {{"skins", skins},
           {"sheets", sheets},
           {"sheets_on_pairs", sheets_on_pairs},
           {"shells", shells},
           {"crescents", crescents},
           {"gaps", gaps},
           {"chains", chains},
           {"wedges", wedges},
           {"foot_of_a_rod", [] { return rod_in_a_plate().scene(); }, foot_cameras},
           hair(0.4),
           hair(0.6),
           hair(3)}};
}

}  // namespace stress
