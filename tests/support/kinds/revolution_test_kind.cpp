// The test kind of the revolution.
#include "kinds/povray_text.hpp"
#include "kinds/test_kind.hpp"

namespace test_support {
namespace {

using csgcore::LongVec3;
using csgcore::Primitive;
using csgcore::Real;
using csgcore::Vec3;

class RevolutionTestKind final : public TestKind {
 public:
  std::span<const Variant> variants() const override { return {}; }
  bool holds(const Primitive&, const Vec3&) const override { return false; }
  Vec3 surface_point(const Primitive&, std::mt19937&) const override { return Vec3(0.0); }
  Vec3 core(const Primitive&, const Vec3&) const override { return Vec3(0.0); }
  LongVec3 middle(const Primitive& p) const override {
    return LongVec3(p.local_to_world.translation);
  }
  Real reach_world(const Primitive&) const override { return 0; }
  std::vector<Side> sides(const Primitive&, const LongVec3&) const override { return {}; }
  std::unique_ptr<const csgcore::reference::LocalSolid> solid(const Primitive&) const override {
    return nullptr;
  }
  double furthest(const Primitive&, const Vec3&) const override { return 0; }
  Heights heights(const Primitive&) const override { return {0, 0}; }
  Vec3 on_surface(const Primitive&, const Vec3&, double) const override { return Vec3(0.0); }
  std::string as_povray(const Primitive&) const override { return {}; }
};

constexpr RevolutionTestKind kTestKind;

}  // namespace

constinit const TestKind& Revolution_test_kind = kTestKind;

}  // namespace test_support
