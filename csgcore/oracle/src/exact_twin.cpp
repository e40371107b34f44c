#include "exact_twin.hpp"

#include <stdexcept>

namespace oracle {

// The file of each kind defines its twin.
#define ORACLE_DECLARE(Name) extern const ExactTwin& Name##_twin;
CSGCORE_FOR_EACH_SHAPE(ORACLE_DECLARE)
#undef ORACLE_DECLARE

const ExactTwin& twin_of(csgcore::Shape shape) {
  switch (shape) {
#define ORACLE_CASE(Name)       \
  case csgcore::Shape::k##Name: \
    return Name##_twin;
    CSGCORE_FOR_EACH_SHAPE(ORACLE_CASE)
#undef ORACLE_CASE
  }
  throw std::logic_error("a shape that is none");
}

Walls<Exact> ExactTwin::walls(const Target<Exact>&, const Vector<Exact>&,
                              const Vector<Exact>&) const {
  return {};
}

Walls<Interval> ExactTwin::walls(const Target<Interval>&, const Vector<Interval>&,
                                 const Vector<Interval>&) const {
  return {};
}

Vector<Interval> ExactTwin::wall_normal(const Target<Interval>&, const Vector<Interval>&) const {
  return {};
}

}  // namespace oracle
