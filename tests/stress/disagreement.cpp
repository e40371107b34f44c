#include "disagreement.hpp"

#include <sstream>

namespace stress {
namespace {

std::string cpp_of(const Vec3& v) {
  std::ostringstream text;
  text.precision(17);
  text << "{" << v.x << ", " << v.y << ", " << v.z << "}";
  return text.str();
}

std::string cpp_of(const View& view) {
  const bool perspective = view.projection == Projection::kPerspective;
  std::ostringstream text;
  text.precision(17);
  text << "const View view{Projection::" << (perspective ? "kPerspective" : "kOrthographic") << ", "
       << cpp_of(view.eye) << ", " << cpp_of(view.right) << ", " << cpp_of(view.up) << ", "
       << cpp_of(view.forward) << ", " << view.half_height << ", " << view.width_px << ", "
       << view.height_px << "};\n";
  return text.str();
}

}  // namespace

std::string minimised(const Scene& scene, const View& view, size_t pixel,
                      const oracle::Shows& shows, uint32_t most_tries) {
  const Scene smallest = oracle::minimise(scene, shows, most_tries);
  return "pixel " + std::to_string(pixel % view.width_px) + ", " +
         std::to_string(pixel / view.width_px) + " of\n" + oracle::as_cpp(smallest) + cpp_of(view) +
         "in OpenSCAD:\n" + oracle::as_openscad(smallest);
}

}  // namespace stress
