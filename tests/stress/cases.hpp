// The named scenes of the stress suite, in families, each with its cameras.
#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"
#include "parts.hpp"

namespace stress {

using csgcore::Box;
using csgcore::Projection;
using csgcore::View;

/// Size of the suite's pictures.
struct PictureSize {
  uint32_t width_px, height_px;
};

struct Camera {
  std::string name;
  View view;
};

/// Makes three cameras for a scene.
using Cameras = std::function<std::vector<Camera>(const Scene&, PictureSize)>;

/// Returns a perspective view from 25° around and 35° above, an orthographic view exactly from
/// above, and a perspective view from near the ground, close by.
std::vector<Camera> default_cameras(const Scene& scene, PictureSize size);
/// Returns three cameras for which no row or diagonal of pixels runs along an edge.
std::vector<Camera> cameras_off_edges(const Scene& scene, PictureSize size);

struct Case {
  std::string name;  // FAMILY/NAME
  std::function<Scene()> make;
  Cameras cameras = default_cameras;
  bool only_full_run = false;
  /// Squares of its lengths are beyond a float: GL needs the scene scaled (frontend::render).
  bool beyond_float = false;
};

struct Family {
  std::string name;
  std::vector<Case> cases;
  /// Faces coincide everywhere: GL's bar is on speckle.
  bool is_coincident = false;
  /// Many rays meet edges exactly, where either face is right: there is no bar on undecided pixels.
  bool has_ties = false;
};

/// Prints a family for GoogleTest.
inline void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }

/// All families, in the order of the table.
const std::vector<Family>& families();

/// The families, each made by the file of that name.
std::vector<Family> coincident_families();
std::vector<Family> thin_families();
std::vector<Family> far_families();
std::vector<Family> singular_families();
std::vector<Family> tree_families();
std::vector<Family> polyhedron_families();
std::vector<Family> mesh_families();
Family tolerance_family();
std::vector<Family> design_families();

/// Adds cases of the part under extreme maps: huge, tiny, far away, sheared, mirrored, stretched,
/// nearly flat.
void add_mapped(Part (*make)(), Family& family);

// --- Cameras ---

/// Returns the model's box, or a box about the origin if the model is empty.
Box camera_box(const Scene& scene);

/// Returns a view from the direction given by two angles (degrees: around z, above the xy plane)
/// towards the middle of the box, from `distance` diagonals away. The box fills most of the
/// picture's height.
View view_around(const Box& box, PictureSize size, Projection projection, double around_deg,
                 double above_deg, double distance);

/// Returns a view exactly along −x, −y or −z (axis 0, 1, 2) towards the middle of the box: every
/// component of the view's axes is 0, 1 or −1.
View view_along(const Box& box, PictureSize size, Projection projection, int axis, double distance);

}  // namespace stress
