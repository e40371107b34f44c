// The revolution's traits.
#include "base/primitive_traits.hpp"

namespace frontend {
namespace {

class RevolutionTraits final : public PrimitiveTraits {};

constexpr RevolutionTraits kRevolutionTraits;

}  // namespace

constinit const PrimitiveTraits& Revolution_traits = kRevolutionTraits;

}  // namespace frontend
