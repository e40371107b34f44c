// The triangle mesh's traits.
#include "base/primitive_traits.hpp"

namespace frontend {
namespace {

class MeshTraits final : public PrimitiveTraits {};

constexpr MeshTraits kTraits;

}  // namespace

constinit const PrimitiveTraits& Mesh_traits = kTraits;

}  // namespace frontend
