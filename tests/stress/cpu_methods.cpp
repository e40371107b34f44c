#include "cpu_methods.hpp"

#include <algorithm>
#include <memory>

#include "csgcore/subdivision.hpp"
#include "csgcore/tracer.hpp"

namespace stress {
namespace {

using csgcore::Hits;
using csgcore::Solid;
using csgcore::Subdivision;
using csgcore::SubdivisionOptions;

Method tiles() {
  return {"tiles", [](const Scene&, const Solid& solid) -> Drawer {
            return [&solid](const View& view) {
              Hits hits;
              csgcore::TraceStats stats;
              csgcore::trace(solid, view, {}, hits, stats);
              return hits;
            };
          }};
}

Method kd_tree(const std::string& name, const SubdivisionOptions& options) {
  return {name, [options](const Scene&, const Solid& solid) -> Drawer {
            const auto subdivision = std::make_shared<Subdivision>(solid, options);
            return [subdivision](const View& view) {
              Hits hits;
              csgcore::TraceStats stats;
              csgcore::trace(*subdivision, view, {}, hits, stats);
              return hits;
            };
          }};
}

/// The paper's rule, but with no cell dropped: then its picture is exact, too.
SubdivisionOptions paper_without_threshold() {
  SubdivisionOptions options = SubdivisionOptions::paper(1, View{});
  options.threshold_px = 0;
  options.view.reset();
  return options;
}

}  // namespace

std::vector<Method> cpu_methods() {
  std::vector<Method> methods{tiles()};
  for (const uint32_t leaf_primitives : {1, 2, 4, 8, 16, 64}) {
    SubdivisionOptions options;
    options.leaf_primitives = leaf_primitives;
    methods.push_back(kd_tree("K=" + std::to_string(leaf_primitives), options));
  }
  methods.push_back(kd_tree("paper", paper_without_threshold()));
  return methods;
}

Method cpu_method(const std::string& name) {
  const std::vector<Method> methods = cpu_methods();
  return *std::find_if(methods.begin(), methods.end(),
                       [&](const Method& method) { return method.name == name; });
}

}  // namespace stress
