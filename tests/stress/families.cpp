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

}  // namespace stress
