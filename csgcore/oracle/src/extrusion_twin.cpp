// The exact twin of the extrusion.
#include "csgcore/half_space.hpp"
#include "exact_twin.hpp"

namespace oracle {
namespace {

using csgcore::Primitive;

class ExtrusionTwin final : public ExactTwin {
 public:
  Vector<Exact> middle(const Primitive&) const override { return {}; }
  void add_surfaces(const Primitive&, const Exact&, Target<Exact>&) const override {}
  void merge_box(const csgcore::Vec3&, const Primitive&, csgcore::Box&) const override {}
  std::vector<csgcore::HalfSpace> half_spaces(const Primitive&, int) const override { return {}; }
  std::string as_cpp(const Primitive&, const std::string&) const override { return {}; }
  std::string as_openscad(const Primitive&) const override { return {}; }
  std::vector<double*> sizes(Primitive&) const override { return {}; }
  std::vector<Primitive> simpler(const Primitive&) const override { return {}; }
};

constexpr ExtrusionTwin kTwin;

}  // namespace

constinit const ExactTwin& Extrusion_twin = kTwin;

}  // namespace oracle
