#include "cases.hpp"

namespace stress {

const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> result;
    for (const std::vector<Family>& some : {coincident_families(),
                                            thin_families(),
                                            far_families(),
                                            singular_families(),
                                            tree_families(),
                                            polyhedron_families(),
                                            mesh_families(),
                                            {tolerance_family()},
                                            design_families()}) {
      result.insert(result.end(), some.begin(), some.end());
    }
    return result;
  }();
  return all;
}

void add_mapped(Part (*make)(), Family& family) {
  const auto add = [&](const char* name, const Mat3& map, const Vec3& at = Vec3{0.0}) {
    family.cases.push_back({name, [=] { return make().under({map, at}).scene(); }});
  };
  add("1e12", Mat3{1e12});
  add("1e-9", Mat3{1e-9});
  add("at_1e6", Mat3{1.0}, {1e6, -1e6, 1e6});
  add("at_1e9", Mat3{1.0}, {1e9, -1e9, 1e9});
  add("sheared", {{1, 0.2, 0}, {0.6, 1, 0.1}, {0.3, -0.5, 1}}, {1, 2, 3});
  add("mirrored", {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}});
  add("stretched", {{1, 0, 0}, {0, 30, 0}, {0, 0, 1000}});
  add("nearly_flat", {{1, 0.5, 0.3}, {1, 0.50001, 0.3}, {0.2, -0.4, 1}});
}

}  // namespace stress
