// The extrusion's traits.
#include "base/primitive_traits.hpp"

namespace frontend {
namespace {

class ExtrusionTraits final : public PrimitiveTraits {};

constexpr ExtrusionTraits kExtrusionTraits;

}  // namespace

constinit const PrimitiveTraits& Extrusion_traits = kExtrusionTraits;

}  // namespace frontend
