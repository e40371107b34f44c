#include "subtrees/node_row.hpp"

namespace frontend {

const NodeRow kRoofRow{.role = Role::kUnknown};

}  // namespace frontend
